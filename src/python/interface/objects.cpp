#include "python/interface/objects.h"

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

}  // namespace splotchcl::py
