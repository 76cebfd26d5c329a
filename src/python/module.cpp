#include <pybind11/pybind11.h>

#include <algorithm>
#include <string>

#include "python/bindings.h"
#include "python/progress.h"
#include "python/source.h"
#include "splotchcl/error.h"

// The module splotchcl._core: the library's values and functions as they are. What users call is
// written in Python around it.
namespace splotchcl::python {
namespace {

constexpr const char* module_name = "splotchcl._core";

py::object new_error(const char* name, const py::handle& bases) {
  const std::string full_name = std::string(module_name) + "." + name;
  return py::reinterpret_steal<py::object>(
      PyErr_NewException(full_name.c_str(), bases.ptr(), nullptr));
}

// Each is an Error of the library and one of Python's own kind.
void add_errors(py::module_& module) {
  const py::object error = new_error("Error", py::handle(PyExc_Exception));
  const auto add = [&](const char* name, PyObject* kind) {
    module.attr(name) = new_error(name, py::make_tuple(error, py::handle(kind)));
  };
  module.attr("Error") = error;
  add("UsageError", PyExc_ValueError);
  add("DataError", PyExc_OSError);
  add("DeviceError", PyExc_RuntimeError);
}

// What a compiler says has several lines. Names of files that are no UTF-8 are what Python makes of
// them.
void raise(const char* name, const Error& error) {
  std::string message = error.what();
  std::replace(message.begin(), message.end(), '\n', ' ');
  const py::object kind = py::module_::import(module_name).attr(name);
  const py::object text = py::reinterpret_steal<py::object>(PyUnicode_DecodeUTF8(
      message.data(), static_cast<Py_ssize_t>(message.size()), "surrogateescape"));
  if (text) PyErr_SetObject(kind.ptr(), text.ptr());
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const UsageError& error) {
    raise("UsageError", error);
  } catch (const DataError& error) {
    raise("DataError", error);
  } catch (const DeviceError& error) {
    raise("DeviceError", error);
  } catch (const Error& error) {
    raise("Error", error);
  }
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  module.attr("version") = SPLOTCHCL_VERSION;
  add_errors(module);
  py::register_exception_translator(&translate);
  survive_cut_files();
  py::module_::import("atexit").attr("register")(py::cpp_function(&end_other_work));
  py::module_::import("os").attr("register_at_fork")(py::arg("after_in_child") =
                                                         py::cpp_function(&forget_other_work));
  bind_sources(module);
  bind_scenes(module);
  bind_pictures(module);
  bind_drawing(module);
  bind_maps(module);
  bind_films(module);
  bind_galaxy(module);
}

}  // namespace splotchcl::python
