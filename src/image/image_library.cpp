#include "image/image_library.h"

#include <dlfcn.h>

#include "splotchcl/error.h"

namespace splotchcl {
namespace {

constexpr char module_name[] = "libsplotchcl_openimageio.so";

// Beside the program or library that this is part of, where it is there: in a build folder, and
// with the address sanitizer, whose own dlopen does not look where we would.
std::string module_file() {
  static const char here = 0;
  Dl_info part;
  if (dladdr(&here, &part) == 0 || part.dli_fname == nullptr) return module_name;
  const std::filesystem::path beside =
      std::filesystem::absolute(part.dli_fname).parent_path() / module_name;
  std::error_code ignored;
  return std::filesystem::exists(beside, ignored) ? beside.string() : module_name;
}

// Never unloaded: many of the libraries that come along cannot be.
const ImageLibrary& load() {
  // Else by its name alone, so that it is looked for where the loader looks for us.
  void* const module = dlopen(module_file().c_str(), RTLD_NOW | RTLD_LOCAL);
  if (module == nullptr) {
    throw DataError(std::string("pictures need ") + module_name + ", which cannot be loaded (" +
                    dlerror() +
                    "); it belongs beside the program, or beside libsplotchcl, and is in Debian's "
                    "package splotchcl-openimageio");
  }
  void* const entry = dlsym(module, image_library_entry);
  if (entry == nullptr) {
    throw DataError(std::string(module_name) + " is not of this version of splotchcl (" +
                    dlerror() + "); install both again");
  }
  return *reinterpret_cast<ImageLibraryEntry*>(entry)();
}

}  // namespace

const ImageLibrary& image_library() {
  static const ImageLibrary& library = load();
  return library;
}

}  // namespace splotchcl
