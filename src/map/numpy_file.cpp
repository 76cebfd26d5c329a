#include <fmt/format.h>

#include <cstring>

#include "map/map_files.h"

namespace splotchcl {

std::vector<float> upside_down(const std::vector<float>& values, int width, int height) {
  const auto row = static_cast<std::size_t>(width), rows = static_cast<std::size_t>(height);
  std::vector<float> turned;
  turned.reserve(values.size());
  for (std::size_t plane = 0; plane < values.size(); plane += row * rows) {
    for (std::size_t y = rows; y-- > 0;) {
      const float* const first = values.data() + plane + y * row;
      turned.insert(turned.end(), first, first + row);
    }
  }
  return turned;
}

// Version 1.0 of NumPy's format: the header is padded so that the values begin at a multiple of 64
// bytes.
std::vector<unsigned char> encode_npy(const Map& map) {
  const std::string planes = map.velocity ? fmt::format("{}, ", map.velocity->channels)
                             : map.effective_particles.empty() ? ""
                                                               : "2, ";
  std::string header =
      fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}{}, {}), }}", planes,
                  map.height, map.width);
  constexpr std::size_t start = 10, alignment = 64;
  while ((start + header.size() + 1) % alignment != 0)
    header += ' ';
  header += '\n';

  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(header.size() & 0xff);
  bytes += static_cast<char>(header.size() >> 8);
  bytes += header;
  std::vector<float> values = upside_down(map.values, map.width, map.height);
  const std::vector<float> second = upside_down(map.effective_particles, map.width, map.height);
  values.insert(values.end(), second.begin(), second.end());
  std::vector<unsigned char> file(bytes.size() + values.size() * sizeof(float));
  std::memcpy(file.data(), bytes.data(), bytes.size());
  std::memcpy(file.data() + bytes.size(), values.data(), values.size() * sizeof(float));
  return file;
}

}  // namespace splotchcl
