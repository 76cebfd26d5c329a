#include "modules/module_file.h"

#include <dlfcn.h>

#include <optional>
#include <system_error>
#include <vector>

#include "splotchcl/error.h"
#include "system/system.h"

namespace splotchcl {
namespace {

namespace fs = std::filesystem;

// If `folder` ends with `end`, what is before that.
std::optional<fs::path> without_end(fs::path folder, fs::path end) {
  while (!end.empty()) {
    if (folder.filename() != end.filename()) return std::nullopt;
    folder = folder.parent_path();
    end = end.parent_path();
  }
  return folder;
}

}  // namespace

fs::path file_mapped_at(const void* address) {
  const fs::path file = of_system::file_around(address);
  if (!file.empty()) return file;
  throw DataError(
      "the system does not say where splotchcl lies, so that its modules are not found; expected "
      "/proc to be mounted, or the program to be started by its whole path");
}

std::vector<fs::path> module_places(const fs::path& own_folder) {
  std::vector<fs::path> places = {own_folder};
  // Of the program, and of the module for Python in Debian's package.
  for (const char* const folder : {SPLOTCHCL_BINDIR, "lib/python3/dist-packages/splotchcl"}) {
    if (const auto prefix = without_end(own_folder, folder))
      places.push_back(*prefix / SPLOTCHCL_LIBDIR);
  }
  return places;
}

std::string module_file(const std::string& module_name) {
  static const char here = 0;
  const std::vector<fs::path> places = module_places(file_mapped_at(&here).parent_path());
  for (const fs::path& place : places) {
    std::error_code ignored;
    if (fs::exists(place / module_name, ignored)) return (place / module_name).string();
  }
  return (places.front() / module_name).string();
}

void* module_entry(const std::string& module_name, const char* entry_name,
                   const std::string& needed_by, const std::string& advice, ModuleSymbols symbols) {
  const int scope = symbols == ModuleSymbols::global ? RTLD_GLOBAL : RTLD_LOCAL;
  void* const module = dlopen(module_file(module_name).c_str(), RTLD_NOW | scope);
  if (module == nullptr) {
    const std::string reason = dlerror();
    throw DataError(needed_by + " " + module_name + ", which cannot be loaded (" + reason + "); " +
                    advice);
  }
  void* const entry = dlsym(module, entry_name);
  if (entry == nullptr) {
    throw DataError(module_name + " is not of this version of splotchcl (" + dlerror() +
                    "); install both again");
  }
  return entry;
}

}  // namespace splotchcl
