#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>

#include "python/interface/casts.h"
#include "python/interface/errors.h"

namespace splotchcl::py {

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

}  // namespace splotchcl::py
