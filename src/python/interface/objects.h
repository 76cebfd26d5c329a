#pragma once

// Python's limited interface, so that one module fits every Python from 3.10 on. pybind11 has no
// such, and nanobind needs 3.12.
#include <Python.h>

#include <exception>
#include <memory>
#include <string>
#include <utility>
#include <vector>

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

}  // namespace splotchcl::py
