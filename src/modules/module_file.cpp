#include "modules/module_file.h"

#include <dlfcn.h>

#include <filesystem>
#include <system_error>

namespace splotchcl {

std::string module_file(const std::string& module_name) {
  static const char here = 0;
  Dl_info part;
  if (dladdr(&here, &part) == 0 || part.dli_fname == nullptr) return module_name;
  const std::filesystem::path beside =
      std::filesystem::absolute(part.dli_fname).parent_path() / module_name;
  std::error_code ignored;
  return std::filesystem::exists(beside, ignored) ? beside.string() : module_name;
}

}  // namespace splotchcl
