#pragma once

#include <zlib.h>

#include <cstdint>
#include <string>

namespace splotchcl::test {

inline std::string little(std::uint32_t number, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i)
    text += static_cast<char>(number >> (8 * i) & 255U);
  return text;
}

inline std::string big(std::uint32_t number, int bytes) {
  const std::string text = little(number, bytes);
  return {text.rbegin(), text.rend()};
}

inline std::string chunk_of_png(const std::string& name_and_data) {
  const auto sum = ::crc32(0, reinterpret_cast<const Bytef*>(name_and_data.data()),
                           static_cast<uInt>(name_and_data.size()));
  return big(static_cast<std::uint32_t>(name_and_data.size() - 4), 4) + name_and_data +
         big(static_cast<std::uint32_t>(sum), 4);
}

}  // namespace splotchcl::test
