#include "common/folders.h"

#include <system_error>

#include "splotchcl/error.h"

namespace splotchcl {

std::filesystem::path temporary_folder() {
  std::error_code error;
  std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  if (!error) return folder;
  throw DataError(
      "environment variable TMPDIR: found no folder, expected one for temporary files; correct it "
      "or unset it");
}

}  // namespace splotchcl
