#include "python/progress.h"

namespace splotchcl::python {

std::function<void(const std::string&, double)> Progress::function() const {
  return [this](const std::string& what, double fraction) { (*this)(what, fraction); };
}

void Progress::operator()(const std::string& what, double fraction) const {
  const py::gil_scoped_acquire lock;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  if (!callable_.is_none()) callable_(what, fraction);
}

}  // namespace splotchcl::python
