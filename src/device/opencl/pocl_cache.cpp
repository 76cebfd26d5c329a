#include "device/opencl/pocl_cache.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace splotchcl {
namespace {

namespace fs = std::filesystem;

constexpr const char* variable = "POCL_CACHE_DIR";

fs::path from_environment(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? fs::path() : fs::path(value);
}

// A folder that is missing is made, as PoCL does it. What access() says is not enough: root may
// write to /proc by it.
bool can_be_written(const fs::path& folder) {
  std::error_code ignored;
  fs::create_directories(folder, ignored);
  std::string tried = (folder / "splotchcl-XXXXXX").string();
  return ::mkdtemp(tried.data()) != nullptr && ::rmdir(tried.c_str()) == 0;
}

// Where PoCL's folder lies; empty where it takes one among temporary files, under a name that
// everybody knows.
fs::path folder_above() {
  if (const fs::path cache = from_environment("XDG_CACHE_HOME"); !cache.empty()) return cache;
  const fs::path home = from_environment("HOME");
  return home.empty() ? fs::path() : home / ".cache";
}

// PoCL runs what lies in its folder: one in the folder that is current, or that others made, or may
// write to, may hold anyone's code.
bool may_be_of_others(const fs::path& above) {
  if (!above.is_absolute()) return true;
  struct stat status = {};
  return ::stat((above / "pocl").c_str(), &status) == 0 &&
         (status.st_uid != ::geteuid() || (status.st_mode & S_IWOTH) != 0);
}

bool is_own(const fs::path& folder) {
  struct stat status = {};
  return ::lstat(folder.c_str(), &status) == 0 && S_ISDIR(status.st_mode) &&
         status.st_uid == ::geteuid() && (status.st_mode & (S_IWGRP | S_IWOTH)) == 0;
}

}  // namespace

std::string unwritable_pocl_cache() {
  if (const fs::path own = from_environment(variable); !own.empty()) {
    return can_be_written(own) ? "" : own.string();
  }
  const fs::path above = folder_above();
  if (above.empty()) return "";
  const fs::path folder = above / "pocl";
  std::error_code ignored;
  const bool is_there = fs::exists(folder, ignored);
  return can_be_written(is_there ? folder : above) ? "" : folder.string();
}

void give_pocl_a_cache() {
  if (!from_environment(variable).empty()) return;
  ::unsetenv(variable);  // an empty one, with which PoCL ends the program
  if (!may_be_of_others(folder_above()) && unwritable_pocl_cache().empty()) return;
  std::error_code error;
  const fs::path folder =
      fs::temp_directory_path(error) / ("splotchcl-pocl-" + std::to_string(::geteuid()));
  if (error) return;
  ::mkdir(folder.c_str(), S_IRWXU);
  if (is_own(folder)) ::setenv(variable, folder.c_str(), 0);
}

}  // namespace splotchcl
