#pragma once

#include <pybind11/pybind11.h>

#include <map>
#include <string>

#include "splotchcl/image.h"
#include "splotchcl/image_file.h"

namespace splotchcl::python {

// Adds Scene and what makes scenes to the module.
void bind_scenes(pybind11::module_& module);

// Adds Drawer, maps, films, galaxies and the list of devices to the module.
void bind_drawing(pybind11::module_& module);
void bind_maps(pybind11::module_& module);
void bind_films(pybind11::module_& module);
void bind_galaxy(pybind11::module_& module);

// A picture and how it is stored.
struct PictureObject {
  Image image;  // as displays show it
  ImageFileOptions options;
  Image light = {};  // as drawn; empty where that is the same

  const Image& linear() const { return light.pixels.empty() ? image : light; }
};

// Adds Picture to the module.
void bind_pictures(pybind11::module_& module);

}  // namespace splotchcl::python
