#include "common/marked_file.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>

#include "common/mapped_file.h"
#include "splotchcl/error.h"

namespace splotchcl {

bool is_another_file(const std::filesystem::path& path, const FileMark& mark) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return false;
  if (!std::filesystem::is_regular_file(path, ignored)) return true;
  std::shared_ptr<const MappedFile> file;
  try {
    file = MappedFile::open(path);
  } catch (const DataError&) {  // nobody knows
    return true;
  }
  const auto there = static_cast<std::size_t>(std::min<std::uint64_t>(file->size(), mark.size()));
  return there > 0 && std::memcmp(file->data(), mark.data(), there) != 0;
}

}  // namespace splotchcl
