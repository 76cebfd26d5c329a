#include "modules/module_file.h"

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <optional>
#include <system_error>
#include <vector>

#include "splotchcl/error.h"

namespace splotchcl {
namespace {

namespace fs = std::filesystem;

// "7f0c8000-7f0c9000 r-xp 00000000 08:01 1234   /usr/lib/libsplotchcl.so.0.1": the name where the
// address lies between both.
std::optional<std::string> name_around(const std::string& mapping, std::uintptr_t address) {
  unsigned long long first = 0, end = 0;
  if (std::sscanf(mapping.c_str(), "%llx-%llx", &first, &end) != 2) return std::nullopt;
  if (address < first || address >= end) return std::nullopt;
  const std::size_t name = mapping.find('/');
  if (name == std::string::npos) return std::nullopt;
  return mapping.substr(name);
}

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

// The system's own table, whose names are whole: the loader's are as a caller wrote them, that of a
// program what its first argument claims, and both may begin at a folder that is no longer current.
fs::path file_mapped_at(const void* address) {
  std::ifstream mappings("/proc/self/maps");
  for (std::string mapping; std::getline(mappings, mapping);) {
    const auto name = name_around(mapping, reinterpret_cast<std::uintptr_t>(address));
    if (name) return *name;
  }
  throw DataError(
      "/proc/self/maps does not say where splotchcl lies, so that its modules are not found; "
      "expected /proc to be mounted");
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

}  // namespace splotchcl
