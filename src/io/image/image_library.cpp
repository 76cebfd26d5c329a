#include "io/image/image_library.h"

#include <dlfcn.h>

#include "splotchcl/error.h"

namespace splotchcl {
namespace {

constexpr char module_name[] = "libsplotchcl_openimageio.so";

// Never unloaded: many of the libraries that come along cannot be.
const ImageLibrary& load() {
  // By its name alone, so that it is looked for where the loader looks for us.
  void* const module = dlopen(module_name, RTLD_NOW | RTLD_LOCAL);
  if (module == nullptr) {
    throw DataError(std::string("pictures need ") + module_name + ", which cannot be loaded (" +
                    dlerror() + "); it belongs beside the program, or beside libsplotchcl");
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
