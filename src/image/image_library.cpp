#include "image/image_library.h"

#include <dlfcn.h>

#include "modules/module_file.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

constexpr char module_name[] = "libsplotchcl_openimageio.so";

// Never unloaded: many of the libraries that come along cannot be.
const ImageLibrary& load() {
  void* const module = dlopen(module_file(module_name).c_str(), RTLD_NOW | RTLD_LOCAL);
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
