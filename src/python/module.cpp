#include "common/guards.h"
#include "python/bindings.h"
#include "python/interface/functions.h"
#include "python/progress.h"
#include "python/source.h"

// The module splotchcl._core: the library's values and functions as they are. What users call is
// written in Python around it.
namespace splotchcl::python {
namespace {

// Of os, whose arguments have names.
void register_at_fork(const py::Object& in_child) {
  const py::Object function = py::import_module("os").attribute("register_at_fork");
  const py::Object none_placed = py::tuple_of({});
  py::Dict named;
  named.set("after_in_child", in_child);
  py::Object::owning(PyObject_Call(function.get(), none_placed.get(), named.object().get()));
}

void fill(py::Module& module) {
  module.object().set_attribute("version", py::to(SPLOTCHCL_VERSION));
  py::add_errors(module);
  survive_cut_files();
  const py::Object at_exit = py::import_module("atexit").attribute("register");
  py::call(at_exit, {py::function_object("end_other_work", py::function<&end_other_work>)});
  register_at_fork(py::function_object("forget_other_work", py::function<&forget_other_work>));
  bind_sources(module);
  bind_scenes(module);
  bind_pictures(module);
  bind_drawing(module);
  bind_maps(module);
  bind_films(module);
  bind_galaxy(module);
}

PyModuleDef definition = {
    PyModuleDef_HEAD_INIT, "_core", nullptr, -1, nullptr, nullptr, nullptr, nullptr, nullptr};

}  // namespace
}  // namespace splotchcl::python

PyMODINIT_FUNC PyInit__core() {
  namespace py = splotchcl::py;
  return py::guarded([] {
    py::Object object = py::Object::owning(PyModule_Create(&splotchcl::python::definition));
    py::Module module(object);
    splotchcl::python::fill(module);
    return object.release();
  });
}
