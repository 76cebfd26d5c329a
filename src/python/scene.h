#pragma once

#include <pybind11/pybind11.h>

namespace splotchcl::python {

// Adds Scene and what makes scenes to the module.
void bind_scenes(pybind11::module_& module);

}  // namespace splotchcl::python
