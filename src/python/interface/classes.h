#pragma once

#include <memory>
#include <new>
#include <string>
#include <type_traits>
#include <utility>

#include "python/interface/functions.h"

namespace splotchcl::py {

// The class that objects of T are shared as; another where T derives from a class of the module.
template <typename T>
struct RootOf {
  using Type = T;
};
template <typename T>
using Root = typename RootOf<T>::Type;

// Python's type for T, of the only Python that a process has.
template <typename T>
inline PyTypeObject* type_of = nullptr;

// A type whose objects hold a std::shared_ptr<void>, in the module. Python before 3.11 keeps the
// name's address.
PyTypeObject* new_type(const Module& module, const char* full_name, PyTypeObject* base);
Object new_instance(PyTypeObject* type);
// Throws CastError where the object is not of the type, or holds nothing.
std::shared_ptr<void>& held_by(PyObject* object, PyTypeObject* type);
// Throws UsageError where the object holds something already.
void hold(PyObject* object, std::shared_ptr<void> value);
void add_property(PyTypeObject* type, PyGetSetDef& property);
void add_method(PyTypeObject* type, PyMethodDef& method);

template <typename T, typename>
struct Cast {
  static_assert(std::is_class_v<T>, "a value of another kind needs a Cast");

  static T& from(PyObject* object) {
    return *static_cast<T*>(static_cast<Root<T>*>(held_by(object, type_of<T>).get()));
  }
  static Object to(T value) { return py::to(std::make_shared<T>(std::move(value))); }
};

template <typename T>
struct Cast<std::shared_ptr<T>> {
  static std::shared_ptr<T> from(PyObject* object) {
    const std::shared_ptr<void>& held = held_by(object, type_of<T>);
    return {held, &py::from<T>(object)};
  }
  static Object to(std::shared_ptr<T> value) {
    Object object = new_instance(type_of<T>);
    hold(object.get(), std::shared_ptr<Root<T>>(std::move(value)));
    return object;
  }
};

// Adds a class, by a name like "splotchcl._core.Scene". Its objects are made by functions of the
// module, or as init says.
template <typename T>
class Class {
 public:
  Class(const Module& module, const char* full_name) {
    PyTypeObject* base = nullptr;
    if constexpr (!std::is_same_v<Root<T>, T>) base = type_of<Root<T>>;
    type_of<T> = new_type(module, full_name, base);
  }

  template <typename... A>
  Class& init() {
    return def("__init__", function<&Class::template make<A...>>);
  }
  template <typename Callable>
  Class& def(const char* name, Callable callable) {
    keep(callable);
    PyMethodDef& definition = Entry<Callable, true>::definition;
    definition.ml_name = name;
    add_method(type_of<T>, definition);
    return *this;
  }
  template <typename Callable>
  Class& property(const char* name, Callable callable) {
    keep(callable);
    PyGetSetDef& definition = PropertyEntry<Callable>::definition;
    definition.name = name;
    add_property(type_of<T>, definition);
    return *this;
  }

 private:
  template <typename... A>
  static void make(Object object, A... arguments) {
    hold(object.get(), std::shared_ptr<Root<T>>(std::make_shared<T>(std::move(arguments)...)));
  }
};

}  // namespace splotchcl::py
