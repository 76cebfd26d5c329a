#include "image/image_library.h"

#include "modules/module_file.h"

namespace splotchcl {
namespace {

const ImageLibrary& load() {
  void* const entry =
      module_entry("libsplotchcl_openimageio.so", image_library_entry, "pictures need",
                   "it belongs beside the program, or beside libsplotchcl, and is in Debian's "
                   "package splotchcl-openimageio");
  return *reinterpret_cast<ImageLibraryEntry*>(entry)();
}

}  // namespace

const ImageLibrary& image_library() {
  static const ImageLibrary& library = load();
  return library;
}

}  // namespace splotchcl
