#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace splotchcl {

// A whole number from 0 to 2^64 - 1, exact. One with a point or an exponent, as far as double
// precision has all whole numbers; else nothing.
std::optional<std::uint64_t> whole_number(const std::string& text);

}  // namespace splotchcl
