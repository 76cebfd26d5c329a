#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <string>

namespace splotchcl::python {

namespace py = pybind11;

// Runs work while other threads of Python go on.
template <typename Work>
auto without_python(Work&& work) {
  const py::gil_scoped_release free;
  return work();
}

// Tells a callable of Python, or None, what is being done and the fraction done. What the callable
// raises, and an interruption from the keyboard, end the work.
class Progress {
 public:
  explicit Progress(py::object callable) : callable_(std::move(callable)) {}
  // To be called without Python's lock. Must not outlive this.
  std::function<void(const std::string& what, double fraction)> function() const;
  void operator()(const std::string& what, double fraction) const;

 private:
  py::object callable_;
};

}  // namespace splotchcl::python
