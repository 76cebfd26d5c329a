#pragma once

#include <map>
#include <string>

#include "python/interface/functions.h"
#include "splotchcl/image.h"
#include "splotchcl/image_file.h"

namespace splotchcl::python {

// Adds Scene and what makes scenes to the module.
void bind_scenes(py::Module& module);

// Adds Drawer, maps, films, galaxies and the list of devices to the module.
void bind_drawing(py::Module& module);
void bind_maps(py::Module& module);
void bind_films(py::Module& module);
void bind_galaxy(py::Module& module);

// A picture and how it is stored.
struct PictureObject {
  Image image;  // as displays show it
  ImageFileOptions options;
  Image light = {};  // as drawn; empty where that is the same

  const Image& linear() const { return light.pixels.empty() ? image : light; }
};

// Adds Picture to the module.
void bind_pictures(py::Module& module);

}  // namespace splotchcl::python
