#pragma once

#include <type_traits>

namespace splotchcl {

// How many parts of `by` hold a `value` that is not negative. No sum of both is made, which could
// wrap. The value's type is the result's.
template <typename Integer>
constexpr Integer ceil_divide(Integer value, std::common_type_t<Integer> by) {
  return value / by + (value % by != 0 ? 1 : 0);
}

}  // namespace splotchcl
