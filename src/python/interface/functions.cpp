#include "python/interface/functions.h"

namespace splotchcl::py {

void raise_wrong_argument(const char* function, std::size_t index, PyObject* found,
                          const CastError& error) {
  const std::string message = std::string(function) + ": argument " + std::to_string(index + 1) +
                              ": found " + repr(found) + ", expected " + error.expected;
  PyErr_SetString(PyExc_TypeError, message.c_str());
}

void require_count(const char* function, std::size_t found, std::size_t expected) {
  if (found == expected) return;
  const std::string message = std::string(function) + ": found " + std::to_string(found) +
                              " arguments, expected " + std::to_string(expected);
  PyErr_SetString(PyExc_TypeError, message.c_str());
  throw PythonError();
}

}  // namespace splotchcl::py
