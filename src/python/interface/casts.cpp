#include "python/interface/casts.h"

namespace splotchcl::py {
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

}  // namespace splotchcl::py
