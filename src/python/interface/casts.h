#pragma once

#include <Python.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

// Python's limited interface, so that one module fits every Python from 3.10 on. pybind11 has no
// such, and nanobind needs 3.12.
namespace splotchcl::py {

// What Python raised, on its way through C++.
class PythonError : public std::exception {
 public:
  // Takes what Python has just raised.
  PythonError();
  const char* what() const noexcept override { return "Python raised an exception"; }
  void raise_again() const;

 private:
  struct Raised;
  std::shared_ptr<const Raised> raised_;
};

// Throws PythonError where Python returned nothing.
PyObject* require(PyObject* returned);
void require(bool succeeded);

// Owns one reference. Whoever uses, copies or ends it has Python's lock.
class Object {
 public:
  Object() = default;  // no object at all
  static Object owning(PyObject* returned) { return Object(require(returned)); }
  static Object borrowing(PyObject* object);
  Object(const Object& other);
  Object(Object&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  Object& operator=(Object other) noexcept;
  ~Object();

  PyObject* get() const { return object_; }
  PyObject* release() { return std::exchange(object_, nullptr); }
  bool is_none() const { return object_ == Py_None; }
  Object attribute(const char* name) const;
  void set_attribute(const char* name, const Object& value) const;

 private:
  explicit Object(PyObject* object) : object_(object) {}

  PyObject* object_ = nullptr;
};

Object none();
Object import_module(const char* name);
Object text_of(const std::string& text, const char* errors = "strict");
std::string repr(PyObject* object);

Object tuple_of(std::vector<Object> values);
Object list_of(std::vector<Object> values);
Object call(const Object& callable, std::vector<Object> arguments);

// Python's lock, for a thread that let go of it or never had it.
class Lock {
 public:
  Lock() : state_(PyGILState_Ensure()) {}
  ~Lock() { PyGILState_Release(state_); }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  PyGILState_STATE state_;
};

// A value of Python that is not of the kind which is expected, as "a number".
struct CastError {
  std::string expected;
};

// Between values of Python and of C++. In general T is a class of the module (Class).
template <typename T, typename = void>
struct Cast;

template <typename T>
Object to(T&& value) {
  return Cast<std::decay_t<T>>::to(std::forward<T>(value));
}

// Throws CastError.
template <typename T>
decltype(auto) from(PyObject* object) {
  return Cast<T>::from(object);
}

// Where they fail, they throw CastError.
bool truth_from(PyObject* object);
std::int64_t whole_number_from(PyObject* object);
std::uint64_t natural_number_from(PyObject* object);
double number_from(PyObject* object);
std::string_view text_from(PyObject* object);
std::filesystem::path path_from(PyObject* object);
Object path_object(const std::filesystem::path& path);
std::vector<Object> sequence_from(PyObject* object);
std::vector<std::pair<Object, Object>> items_from(PyObject* dict);

template <>
struct Cast<Object> {
  static Object from(PyObject* object) { return Object::borrowing(object); }
  static Object to(Object value) { return value; }
};

template <>
struct Cast<bool> {
  static bool from(PyObject* object) { return truth_from(object); }
  static Object to(bool value) { return Object::owning(PyBool_FromLong(value ? 1 : 0)); }
};

template <typename T>
struct Cast<T, std::enable_if_t<std::is_integral_v<T>>> {
  using Widest = std::conditional_t<std::is_signed_v<T>, std::int64_t, std::uint64_t>;

  static T from(PyObject* object) {
    Widest value{};
    if constexpr (std::is_signed_v<T>) {
      value = whole_number_from(object);
    } else {
      value = natural_number_from(object);
    }
    using Limits = std::numeric_limits<T>;
    if (value < Limits::min() || value > Limits::max()) {
      throw CastError{"a whole number between " + std::to_string(Limits::min()) + " and " +
                      std::to_string(Limits::max())};
    }
    return static_cast<T>(value);
  }
  static Object to(T value) {
    if constexpr (std::is_signed_v<T>) {
      return Object::owning(PyLong_FromLongLong(value));
    } else {
      return Object::owning(PyLong_FromUnsignedLongLong(value));
    }
  }
};

template <typename T>
struct Cast<T, std::enable_if_t<std::is_floating_point_v<T>>> {
  static T from(PyObject* object) { return static_cast<T>(number_from(object)); }
  static Object to(T value) {
    return Object::owning(PyFloat_FromDouble(static_cast<double>(value)));
  }
};

template <>
struct Cast<std::string> {
  static std::string from(PyObject* object) { return std::string(text_from(object)); }
  static Object to(const std::string& text) { return text_of(text); }
};

// Python keeps the text during a call.
template <>
struct Cast<std::string_view> {
  static std::string_view from(PyObject* object) { return text_from(object); }
};

template <>
struct Cast<const char*> {
  static Object to(const char* text) { return text_of(text); }
};

template <>
struct Cast<std::filesystem::path> {
  static std::filesystem::path from(PyObject* object) { return path_from(object); }
  static Object to(const std::filesystem::path& path) { return path_object(path); }
};

template <typename T>
struct Cast<std::optional<T>> {
  static std::optional<T> from(PyObject* object) {
    if (object == Py_None) return std::nullopt;
    return py::from<T>(object);
  }
  static Object to(std::optional<T> value) { return value ? py::to(*std::move(value)) : none(); }
};

template <typename T>
struct Cast<std::vector<T>> {
  static std::vector<T> from(PyObject* object) {
    std::vector<T> values;
    for (const Object& value : sequence_from(object))
      values.push_back(py::from<T>(value.get()));
    return values;
  }
  static Object to(std::vector<T> values) {
    std::vector<Object> objects;
    for (T& value : values)
      objects.push_back(py::to(std::move(value)));
    return list_of(std::move(objects));
  }
};

template <typename T, std::size_t count>
struct Cast<std::array<T, count>> {
  static std::array<T, count> from(PyObject* object) {
    const auto values = py::from<std::vector<T>>(object);
    if (values.size() != count) throw CastError{std::to_string(count) + " values"};
    std::array<T, count> array{};
    std::copy(values.begin(), values.end(), array.begin());
    return array;
  }
  static Object to(const std::array<T, count>& array) {
    return py::to(std::vector<T>(array.begin(), array.end()));
  }
};

template <typename... T>
Object make_tuple(T&&... values) {
  std::vector<Object> objects;
  (objects.push_back(to(std::forward<T>(values))), ...);
  return tuple_of(std::move(objects));
}

template <typename... T>
struct Cast<std::tuple<T...>> {
  static Object to(std::tuple<T...> values) {
    return std::apply([](auto&... each) { return py::make_tuple(std::move(each)...); }, values);
  }
};

template <typename First, typename Second>
struct Cast<std::pair<First, Second>> {
  static Object to(std::pair<First, Second> values) {
    return py::make_tuple(std::move(values.first), std::move(values.second));
  }
};

template <typename T>
struct Cast<std::map<std::string, T>> {
  static std::map<std::string, T> from(PyObject* object) {
    std::map<std::string, T> values;
    for (const auto& [key, value] : items_from(object))
      values.insert_or_assign(std::string(text_from(key.get())), py::from<T>(value.get()));
    return values;
  }
};

// A dictionary that is being filled.
class Dict {
 public:
  Dict() : object_(Object::owning(PyDict_New())) {}

  template <typename T>
  void set(const Object& key, T&& value) {
    require(PyDict_SetItem(object_.get(), key.get(), to(std::forward<T>(value)).get()) == 0);
  }
  template <typename T>
  void set(const std::string& key, T&& value) {
    set(text_of(key), std::forward<T>(value));
  }
  const Object& object() const { return object_; }

 private:
  Object object_;
};

template <>
struct Cast<Dict> {
  static Object to(const Dict& dict) { return dict.object(); }
};

// Values as numpy looks at them where they lie: what a property __array_interface__ gives. Python's
// limited interface has buffers from 3.11 on only.
struct ArrayLayout {
  const void* first = nullptr;
  const char* kind = "f4";  // of a value: f4, u8
  std::vector<std::int64_t> shape;
  std::vector<std::int64_t> strides = {};  // bytes; empty: C order
};

template <>
struct Cast<ArrayLayout> {
  // Read-only.
  static Object to(const ArrayLayout& layout);
};

// A numpy array of numbers of one of these kinds in C order, of the shape (N,) or (N, width). It
// lives as long as somebody has `owner`.
struct ArrayOfNumbers {
  enum class Kind { float32, float64, int64, uint64 };
  const void* first = nullptr;
  Kind kind = Kind::float32;
  std::uint64_t count = 0;
  int width = 1;
  std::shared_ptr<const void> owner;
};

template <>
struct Cast<ArrayOfNumbers> {
  static ArrayOfNumbers from(PyObject* object);
};

}  // namespace splotchcl::py
