#pragma once

#include <pybind11/pybind11.h>

#include <map>
#include <string>

#include "splotchcl/image.h"
#include "splotchcl/image_file.h"

namespace splotchcl::python {

// A picture and how it is stored.
struct PictureObject {
  Image image;
  ImageFileOptions options;
};

// Adds Picture to the module.
void bind_pictures(pybind11::module_& module);

}  // namespace splotchcl::python
