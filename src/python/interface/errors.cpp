#include "python/interface/errors.h"

#include <algorithm>
#include <new>
#include <string>

#include "python/interface/functions.h"
#include "splotchcl/error.h"

namespace splotchcl::py {
namespace {

constexpr const char* module_name = "splotchcl._core";

Object new_error(const char* name, const Object& bases) {
  const std::string full_name = std::string(module_name) + "." + name;
  return Object::owning(PyErr_NewException(full_name.c_str(), bases.get(), nullptr));
}

// What a compiler says has several lines. Names of files that are no UTF-8 are what Python makes of
// them.
void raise(const char* name, const Error& error) {
  std::string message = error.what();
  std::replace(message.begin(), message.end(), '\n', ' ');
  const Object kind = import_module(module_name).attribute(name);
  PyErr_SetObject(kind.get(), text_of(message, "surrogateescape").get());
}

void raise_thrown() {
  try {
    throw;
  } catch (const PythonError& error) {
    error.raise_again();
  } catch (const UsageError& error) {
    raise("UsageError", error);
  } catch (const DataError& error) {
    raise("DataError", error);
  } catch (const DeviceError& error) {
    raise("DeviceError", error);
  } catch (const Error& error) {
    raise("Error", error);
  } catch (const std::bad_alloc&) {
    PyErr_NoMemory();
  } catch (const std::exception& error) {
    PyErr_SetString(PyExc_RuntimeError, error.what());
  }
}

}  // namespace

// Each is an Error of the library and one of Python's own kind.
void add_errors(const Module& module) {
  const Object error = new_error("Error", Object::borrowing(PyExc_Exception));
  const auto add = [&](const char* name, PyObject* kind) {
    const Object bases = tuple_of({error, Object::borrowing(kind)});
    module.object().set_attribute(name, new_error(name, bases));
  };
  module.object().set_attribute("Error", error);
  add("UsageError", PyExc_ValueError);
  add("DataError", PyExc_OSError);
  add("DeviceError", PyExc_RuntimeError);
}

void raise_what_was_thrown() noexcept {
  try {
    raise_thrown();
  } catch (const PythonError& error) {
    error.raise_again();
  }
}

}  // namespace splotchcl::py
