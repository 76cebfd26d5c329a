#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

namespace splotchcl {

// Adds numbers to a file, their lowest bytes first, on any machine.
inline void append(std::string& file, std::uint32_t number) {
  for (int byte = 0; byte < 4; ++byte)
    file += static_cast<char>(number >> (8 * byte) & 255);
}

template <std::size_t count>
void append(std::string& file, const std::array<float, count>& numbers) {
  for (const float number : numbers) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &number, sizeof bits);
    append(file, bits);
  }
}

}  // namespace splotchcl
