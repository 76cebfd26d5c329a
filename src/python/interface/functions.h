#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <new>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>

#include "python/interface/casts.h"

namespace splotchcl::py {

class Module;

// The library's errors as exceptions of Python.
void add_errors(const Module& module);

// Tells Python what was thrown; to be called where an exception is handled.
void raise_what_was_thrown() noexcept;

template <typename Work>
PyObject* guarded(Work&& work) noexcept {
  try {
    return work();
  } catch (...) {
    raise_what_was_thrown();
    return nullptr;
  }
}

// A function, or a member of a class, as a type that has `call`.
template <auto function>
struct Constant;

template <typename Result, typename... A, Result (*function)(A...)>
struct Constant<function> {
  static Result call(A... arguments) { return function(std::forward<A>(arguments)...); }
  using Pointer = Result (*)(A...);
};

template <typename C, typename Result, typename... A, Result (C::*function)(A...)>
struct Constant<function> {
  static Result call(C& object, A... arguments) {
    return (object.*function)(std::forward<A>(arguments)...);
  }
  using Pointer = Result (*)(C&, A...);
};

template <typename C, typename Result, typename... A, Result (C::*function)(A...) const>
struct Constant<function> {
  static Result call(const C& object, A... arguments) {
    return (object.*function)(std::forward<A>(arguments)...);
  }
  using Pointer = Result (*)(const C&, A...);
};

// A variable of a class, to be read.
template <auto variable>
struct Variable;

template <typename C, typename T, T C::*variable>
struct Variable<variable> {
  static T call(const C& object) { return object.*variable; }
  using Pointer = T (*)(const C&);
};

// def(name, function<&draw>): what Python calls is made for each function at compile time.
template <auto callable>
constexpr Constant<callable> function{};
template <auto named>
constexpr Variable<named> variable{};

// What a lambda that captures nothing is, likewise.
template <typename Lambda>
struct OfLambda {
  using Pointer = decltype(+std::declval<Lambda>());
  static inline Pointer call = nullptr;
};

template <typename Callable>
struct Callee {
  using Type = OfLambda<Callable>;
};
template <auto callable>
struct Callee<Constant<callable>> {
  using Type = Constant<callable>;
};
template <auto named>
struct Callee<Variable<named>> {
  using Type = Variable<named>;
};

// An argument, alive during the call. References and pointers are to what Python's object holds;
// a pointer is none for None.
template <typename T>
struct Argument {
  using Value = std::remove_cv_t<std::remove_reference_t<T>>;
  decltype(py::from<Value>(nullptr)) value;

  explicit Argument(PyObject* object) : value(py::from<Value>(object)) {}
  decltype(auto) get() {
    if constexpr (std::is_lvalue_reference_v<T>) {
      return static_cast<T>(value);
    } else if constexpr (std::is_reference_v<decltype(value)>) {
      return Value(value);  // Python keeps its own
    } else {
      return Value(std::move(value));
    }
  }
};

template <typename T>
struct Argument<T*> {
  T* value;

  explicit Argument(PyObject* object)
      : value(object == Py_None ? nullptr : &py::from<std::remove_const_t<T>>(object)) {}
  T* get() const { return value; }
};

void raise_wrong_argument(const char* function, std::size_t index, PyObject* found,
                          const CastError& error);
void require_count(const char* function, std::size_t found, std::size_t expected);

template <typename T>
Argument<T> argument(const char* function, std::size_t index, PyObject* found) {
  try {
    return Argument<T>(found);
  } catch (const CastError& error) {
    raise_wrong_argument(function, index, found, error);
    throw PythonError();
  }
}

template <typename Result, typename... A, std::size_t... index>
Object call_with(Result (*function)(A...), [[maybe_unused]] const char* name,
                 [[maybe_unused]] const std::array<PyObject*, sizeof...(A)>& given,
                 std::index_sequence<index...> /*places*/) {
  // In order, so that the first wrong one is told.
  [[maybe_unused]] std::tuple<Argument<A>...> values{argument<A>(name, index, given[index])...};
  if constexpr (std::is_void_v<Result>) {
    function(std::get<index>(values).get()...);
    return none();
  } else {
    return to(function(std::get<index>(values).get()...));
  }
}

// Of a method the first argument is the object.
template <typename Result, typename... A>
Object call_with(Result (*function)(A...), const char* name, PyObject* object,
                 PyObject* arguments) {
  constexpr std::size_t count = sizeof...(A);
  const std::size_t before = object == nullptr ? 0 : 1;
  const auto found = static_cast<std::size_t>(PyTuple_Size(arguments));
  require_count(name, found + before, count);
  std::array<PyObject*, count> given{};
  if (before > 0) given[0] = object;
  for (std::size_t i = before; i < count; ++i)
    given[i] = require(PyTuple_GetItem(arguments, static_cast<Py_ssize_t>(i - before)));
  return call_with(function, name, given, std::index_sequence_for<A...>());
}

// What Python calls for a function or a method. Its definition lives as long as the module.
template <typename Callable, bool is_method>
struct Entry {
  using Target = typename Callee<Callable>::Type;

  static PyObject* run(PyObject* object, PyObject* arguments) noexcept {
    return guarded([&] {
      const typename Target::Pointer target = Target::call;
      return call_with(target, definition.ml_name, is_method ? object : nullptr, arguments)
          .release();
    });
  }
  static inline PyMethodDef definition = {nullptr, &run, METH_VARARGS, nullptr};
};

// Likewise for what is read without being called.
template <typename Callable>
struct PropertyEntry {
  using Target = typename Callee<Callable>::Type;

  static PyObject* read(PyObject* object, void* /*closure*/) noexcept {
    return guarded([&] {
      const typename Target::Pointer target = Target::call;
      return call_with(target, definition.name, {object}, std::index_sequence<0>()).release();
    });
  }
  static inline PyGetSetDef definition = {nullptr, &read, nullptr, nullptr, nullptr};
};

// A lambda is called as the function that it converts to.
template <typename Callable>
void keep([[maybe_unused]] Callable callable) {
  using Target = typename Callee<Callable>::Type;
  if constexpr (std::is_same_v<Target, OfLambda<Callable>>) Target::call = +callable;
}

template <typename Callable>
Object function_object(const char* name, Callable callable) {
  keep(callable);
  PyMethodDef& definition = Entry<Callable, false>::definition;
  definition.ml_name = name;
  return Object::owning(PyCFunction_NewEx(&definition, nullptr, nullptr));
}

// Adds functions to a module.
class Module {
 public:
  explicit Module(Object object) : object_(std::move(object)) {}

  template <typename Callable>
  Module& def(const char* name, Callable callable) {
    object_.set_attribute(name, function_object(name, callable));
    return *this;
  }
  const Object& object() const { return object_; }

 private:
  Object object_;
};

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
