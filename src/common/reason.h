#pragma once

#include <string>
#include <system_error>

namespace splotchcl {

// What the system says of an errno.
inline std::string reason(int error_number) {
  return std::generic_category().message(error_number);
}

}  // namespace splotchcl
