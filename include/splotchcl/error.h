#pragma once

#include <stdexcept>
#include <string>

namespace splotchcl {

// Every failure of the library is an Error. The message is one line that names
// what was found, what was expected, and what to do next; the command line
// prints it as it is.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The call or the scene is wrong, so trying again is of no use: exit code 2.
class UsageError : public Error {
 public:
  using Error::Error;
};

// A file, its contents or its destination failed: exit code 1.
class DataError : public Error {
 public:
  using Error::Error;
};

// No device, or the device failed: exit code 1.
class DeviceError : public Error {
 public:
  using Error::Error;
};

}  // namespace splotchcl
