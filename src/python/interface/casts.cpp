#include "python/interface/casts.h"

#include <map>

namespace splotchcl::py {

// Whoever drops it last may lack Python's lock.
struct PythonError::Raised {
  PyObject *type = nullptr, *value = nullptr, *traceback = nullptr;

  Raised() { PyErr_Fetch(&type, &value, &traceback); }
  ~Raised() {
    const Lock lock;
    Py_XDECREF(type);
    Py_XDECREF(value);
    Py_XDECREF(traceback);
  }
  Raised(const Raised&) = delete;
  Raised& operator=(const Raised&) = delete;
};

PythonError::PythonError() : raised_(std::make_shared<const Raised>()) {}

void PythonError::raise_again() const {
  Py_XINCREF(raised_->type);
  Py_XINCREF(raised_->value);
  Py_XINCREF(raised_->traceback);
  PyErr_Restore(raised_->type, raised_->value, raised_->traceback);
}

PyObject* require(PyObject* returned) {
  if (returned == nullptr) throw PythonError();
  return returned;
}

void require(bool succeeded) {
  if (!succeeded) throw PythonError();
}

Object Object::borrowing(PyObject* object) {
  Py_XINCREF(object);
  return Object(object);
}

Object::Object(const Object& other) : object_(other.object_) {
  Py_XINCREF(object_);
}

Object& Object::operator=(Object other) noexcept {
  std::swap(object_, other.object_);
  return *this;
}

Object::~Object() {
  Py_XDECREF(object_);
}

Object Object::attribute(const char* name) const {
  return owning(PyObject_GetAttrString(object_, name));
}

void Object::set_attribute(const char* name, const Object& value) const {
  require(PyObject_SetAttrString(object_, name, value.get()) == 0);
}

Object none() {
  return Object::borrowing(Py_None);
}

Object import_module(const char* name) {
  return Object::owning(PyImport_ImportModule(name));
}

Object text_of(const std::string& text, const char* errors) {
  return Object::owning(
      PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), errors));
}

std::string repr(PyObject* object) {
  const Object text = Object::owning(PyObject_Repr(object));
  const Object bytes =
      Object::owning(PyUnicode_AsEncodedString(text.get(), "utf-8", "backslashreplace"));
  return PyBytes_AsString(bytes.get());
}

Object tuple_of(std::vector<Object> values) {
  Object tuple = Object::owning(PyTuple_New(static_cast<Py_ssize_t>(values.size())));
  Py_ssize_t place = 0;
  for (Object& value : values)
    require(PyTuple_SetItem(tuple.get(), place++, value.release()) == 0);
  return tuple;
}

Object list_of(std::vector<Object> values) {
  Object list = Object::owning(PyList_New(static_cast<Py_ssize_t>(values.size())));
  Py_ssize_t place = 0;
  for (Object& value : values)
    require(PyList_SetItem(list.get(), place++, value.release()) == 0);
  return list;
}

Object call(const Object& callable, std::vector<Object> arguments) {
  const Object tuple = tuple_of(std::move(arguments));
  return Object::owning(PyObject_CallObject(callable.get(), tuple.get()));
}

namespace {

// What Python found wrong is said by CastError, but for what does not come from the value.
[[noreturn]] void refuse(const char* expected) {
  if (PyErr_Occurred() != nullptr && PyErr_ExceptionMatches(PyExc_Exception) == 0) {
    throw PythonError();
  }
  PyErr_Clear();
  throw CastError{expected};
}

Object index_of(PyObject* object) {
  PyObject* const index = PyNumber_Index(object);
  if (index == nullptr) refuse("a whole number");
  return Object::owning(index);
}

}  // namespace

bool truth_from(PyObject* object) {
  if (object == Py_None) return false;
  if (PyObject_HasAttrString(object, "__bool__") == 0) refuse("True or False");
  const int truth = PyObject_IsTrue(object);
  if (truth < 0) refuse("True or False");
  return truth > 0;
}

std::int64_t whole_number_from(PyObject* object) {
  const long long value = PyLong_AsLongLong(index_of(object).get());
  if (PyErr_Occurred() != nullptr) refuse("a whole number of 64 bits");
  return value;
}

std::uint64_t natural_number_from(PyObject* object) {
  const unsigned long long value = PyLong_AsUnsignedLongLong(index_of(object).get());
  if (PyErr_Occurred() != nullptr) refuse("a whole number >= 0 of 64 bits");
  return value;
}

double number_from(PyObject* object) {
  const double value = PyFloat_AsDouble(object);
  if (PyErr_Occurred() != nullptr) refuse("a number");
  return value;
}

std::string_view text_from(PyObject* object) {
  Py_ssize_t size = 0;
  const char* const text =
      PyUnicode_Check(object) != 0 ? PyUnicode_AsUTF8AndSize(object, &size) : nullptr;
  if (text == nullptr) refuse("text");
  return {text, static_cast<std::size_t>(size)};
}

std::filesystem::path path_from(PyObject* object) {
  PyObject* bytes = nullptr;
  if (PyUnicode_FSConverter(object, &bytes) == 0) refuse("a path");
  const Object owned = Object::owning(bytes);
  return {PyBytes_AsString(bytes)};
}

Object path_object(const std::filesystem::path& path) {
  const Object text = Object::owning(PyUnicode_DecodeFSDefault(path.c_str()));
  return call(import_module("pathlib").attribute("Path"), {text});
}

std::vector<Object> sequence_from(PyObject* object) {
  const bool is_text = PyUnicode_Check(object) != 0 || PyBytes_Check(object) != 0;
  if (is_text || PySequence_Check(object) == 0) refuse("a list");
  const Py_ssize_t size = PySequence_Size(object);
  if (size < 0) refuse("a list");
  std::vector<Object> values;
  for (Py_ssize_t i = 0; i < size; ++i)
    values.push_back(Object::owning(PySequence_GetItem(object, i)));
  return values;
}

std::vector<std::pair<Object, Object>> items_from(PyObject* dict) {
  if (PyDict_Check(dict) == 0) throw CastError{"a dictionary"};
  std::vector<std::pair<Object, Object>> items;
  PyObject *key = nullptr, *value = nullptr;
  for (Py_ssize_t place = 0; PyDict_Next(dict, &place, &key, &value) != 0;)
    items.emplace_back(Object::borrowing(key), Object::borrowing(value));
  return items;
}

namespace {

constexpr char endianness = __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__ ? '<' : '>';
constexpr const char* expected = "a numpy array of floats or doubles in C order";

Object tuple_of_numbers(const std::vector<std::int64_t>& numbers) {
  std::vector<Object> objects;
  for (const std::int64_t number : numbers)
    objects.push_back(to(number));
  return tuple_of(std::move(objects));
}

Object item(const Object& dict, const char* key) {
  PyObject* const found = PyDict_GetItemString(dict.get(), key);
  if (found == nullptr) throw CastError{expected};
  return Object::borrowing(found);
}

// Lets go of the array with Python's lock, which whoever has its last column may lack.
std::shared_ptr<const void> shared(PyObject* array) {
  Py_INCREF(array);
  const auto let_go = [](PyObject* last) {
    const Lock lock;
    Py_DECREF(last);
  };
  return std::shared_ptr<PyObject>(array, let_go);
}

}  // namespace

Object Cast<ArrayLayout>::to(const ArrayLayout& layout) {
  constexpr bool is_read_only = true;
  Dict dict;
  dict.set("version", 3);
  dict.set("typestr", endianness + std::string(layout.kind));
  dict.set("shape", tuple_of_numbers(layout.shape));
  if (!layout.strides.empty()) dict.set("strides", tuple_of_numbers(layout.strides));
  dict.set("data", make_tuple(reinterpret_cast<std::uintptr_t>(layout.first), is_read_only));
  return dict.object();
}

ArrayOfNumbers Cast<ArrayOfNumbers>::from(PyObject* object) {
  if (PyObject_HasAttrString(object, "__array_interface__") == 0) throw CastError{expected};
  const Object layout = Object::borrowing(object).attribute("__array_interface__");
  const auto kind = py::from<std::string>(item(layout, "typestr").get());
  const auto shape = py::from<std::vector<std::int64_t>>(item(layout, "shape").get());
  const auto data = py::from<std::vector<Object>>(item(layout, "data").get());
  using Kind = ArrayOfNumbers::Kind;
  const std::map<std::string, Kind> kinds = {{endianness + std::string("f4"), Kind::float32},
                                             {endianness + std::string("f8"), Kind::float64},
                                             {endianness + std::string("i8"), Kind::int64},
                                             {endianness + std::string("u8"), Kind::uint64}};
  const auto found = kinds.find(kind);
  // Strides are None in C order.
  if (found == kinds.end() || shape.empty() || shape.size() > 2 ||
      !item(layout, "strides").is_none()) {
    throw CastError{expected};
  }
  ArrayOfNumbers array;
  array.first = reinterpret_cast<const void*>(py::from<std::uintptr_t>(data.at(0).get()));
  array.kind = found->second;
  array.count = static_cast<std::uint64_t>(shape[0]);
  array.width = shape.size() > 1 ? static_cast<int>(shape[1]) : 1;
  array.owner = shared(object);
  return array;
}

}  // namespace splotchcl::py
