#pragma once

#include <pybind11/pybind11.h>

namespace splotchcl::python {

// Adds Drawer, maps, films, galaxies and the list of devices to the module.
void bind_drawing(pybind11::module_& module);
void bind_maps(pybind11::module_& module);
void bind_films(pybind11::module_& module);
void bind_galaxy(pybind11::module_& module);

}  // namespace splotchcl::python
