#include "python/interface/functions.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <new>
#include <stdexcept>
#include <string>

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

void raise_wrong_argument(const char* function, std::size_t index, PyObject* found,
                          const CastError& error) {
  const std::string message = std::string(function) + ": argument " + std::to_string(index + 1) +
                              ": found " + repr(found) + ", expected " + error.expected;
  PyErr_SetString(PyExc_TypeError, message.c_str());
}

void require_count(const char* function, std::size_t found, std::size_t expected) {
  if (found == expected) return;
  const std::string message = std::string(function) + ": found " + std::to_string(found) +
                              " arguments, expected " + std::to_string(expected);
  PyErr_SetString(PyExc_TypeError, message.c_str());
  throw PythonError();
}

namespace {

// As Python lays out an object.
struct Instance {
  PyObject head;
  std::shared_ptr<void> held;
};

Object as_object(PyTypeObject* type) {
  return Object::borrowing(reinterpret_cast<PyObject*>(type));
}

Instance* instance(PyObject* object) {
  return reinterpret_cast<Instance*>(object);
}

template <typename Slot>
Slot slot_of(PyTypeObject* type, int slot) {
  return reinterpret_cast<Slot>(PyType_GetSlot(type, slot));
}

PyObject* allocate(PyTypeObject* type, PyObject* /*arguments*/, PyObject* /*named*/) noexcept {
  PyObject* const object = slot_of<allocfunc>(type, Py_tp_alloc)(type, 0);
  if (object != nullptr) new (&instance(object)->held) std::shared_ptr<void>();
  return object;
}

void end(PyObject* object) noexcept {
  PyTypeObject* const type = Py_TYPE(object);
  instance(object)->held.~shared_ptr();
  slot_of<freefunc>(type, Py_tp_free)(object);
  Py_DECREF(type);
}

int refuse_to_make(PyObject* /*object*/, PyObject* /*arguments*/, PyObject* /*named*/) noexcept {
  PyErr_SetString(PyExc_TypeError, "objects of this class are made by functions of the module");
  return -1;
}

}  // namespace

PyTypeObject* new_type(const Module& module, const char* full_name, PyTypeObject* base) {
  std::array<PyType_Slot, 4> slots = {{{Py_tp_new, reinterpret_cast<void*>(&allocate)},
                                       {Py_tp_init, reinterpret_cast<void*>(&refuse_to_make)},
                                       {Py_tp_dealloc, reinterpret_cast<void*>(&end)},
                                       {0, nullptr}}};
  PyType_Spec spec = {full_name, static_cast<int>(sizeof(Instance)), 0,
                      Py_TPFLAGS_DEFAULT | Py_TPFLAGS_BASETYPE, slots.data()};
  const Object bases = base == nullptr ? Object() : tuple_of({as_object(base)});
  Object type = Object::owning(PyType_FromSpecWithBases(&spec, bases.get()));
  module.object().set_attribute(std::strrchr(full_name, '.') + 1, type);
  return reinterpret_cast<PyTypeObject*>(type.release());
}

Object new_instance(PyTypeObject* type) {
  return Object::owning(allocate(type, nullptr, nullptr));
}

std::shared_ptr<void>& held_by(PyObject* object, PyTypeObject* type) {
  if (type == nullptr) throw std::logic_error("a class that is not of the module");
  if (PyObject_TypeCheck(object, type) == 0 || !instance(object)->held) {
    const Object name = as_object(type).attribute("__name__");
    throw CastError{"a " + std::string(text_from(name.get()))};
  }
  return instance(object)->held;
}

void hold(PyObject* object, std::shared_ptr<void> value) {
  if (instance(object)->held) {
    PyErr_SetString(PyExc_TypeError, "found an object that is made already, expected a new one");
    throw PythonError();
  }
  instance(object)->held = std::move(value);
}

void add_property(PyTypeObject* type, PyGetSetDef& property) {
  const Object descriptor = Object::owning(PyDescr_NewGetSet(type, &property));
  as_object(type).set_attribute(property.name, descriptor);
}

void add_method(PyTypeObject* type, PyMethodDef& method) {
  const Object descriptor = Object::owning(PyDescr_NewMethod(type, &method));
  as_object(type).set_attribute(method.ml_name, descriptor);
}

}  // namespace splotchcl::py
