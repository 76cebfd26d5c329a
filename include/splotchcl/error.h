#pragma once

#include <stdexcept>
#include <string>

namespace splotchcl {

// Every failure of the library is an Error. The message is one line that names
// what was found, what was expected, and what to do next; the command line
// prints it as it is. Zero bytes, as text of damaged files has them, are question marks: what()
// would end there.
class Error : public std::runtime_error {
 public:
  explicit Error(std::string message) : std::runtime_error(without_zeros(message)) {}

 private:
  static const std::string& without_zeros(std::string& message) {
    for (char& c : message)
      c = c == '\0' ? '?' : c;
    return message;
  }
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
