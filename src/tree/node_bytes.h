#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

// What the bytes of nodes mean. Lengths that are stored as 0 are 0.
namespace splotchcl {

// Most nodes are looked at for these numbers alone.
template <int size, class Make>
std::vector<double> table_of(const Make& make) {
  std::vector<double> table(size);
  for (int b = 0; b < size; ++b)
    table[static_cast<std::size_t>(b)] = make(b);
  return table;
}

// To 1/1024 of an octave, from 2^-48 to 2^16.
inline std::uint16_t length_bits(double length) {
  if (!(length > 0)) return 0;
  return static_cast<std::uint16_t>(
      std::clamp(std::round((std::log2(length) + 48) * 1023), 1.0, 65535.0));
}
inline double length_of_bits(std::uint16_t bits) {
  static const auto lengths =
      table_of<65536>([](int b) { return b == 0 ? 0 : std::exp2(b / 1023.0 - 48); });
  return lengths[bits];
}

// To an eighth of an octave, from 2^-20 to 2^11.75 of a cell: widths may be many times as large.
inline std::uint8_t rough_bits(double part_of_cell) {
  if (!(part_of_cell > 0)) return 0;
  return static_cast<std::uint8_t>(
      std::clamp(std::round((std::log2(part_of_cell) + 20) * 8), 1.0, 255.0));
}
inline double rough_of_bits(std::uint8_t bits) {
  static const auto roughs =
      table_of<256>([](int b) { return b == 0 ? 0 : std::exp2(b / 8.0 - 20); });
  return roughs[bits];
}

// Smoothing lengths to a quarter of an octave upwards, from 2^-48 to 2^15.
inline std::uint8_t wide_bits(double h) {
  return static_cast<std::uint8_t>(std::clamp(std::ceil((std::log2(h) + 48) * 4), 0.0, 255.0));
}
inline double smoothing_of_bits(std::uint8_t bits) {
  static const auto lengths = table_of<256>([](int b) { return std::exp2(b / 4.0 - 48); });
  return lengths[bits];
}

// NodeMoments::narrowness in three bits, rounded down.
constexpr double narrownesses[] = {1, 0.92, 0.85, 0.75, 0.6, 0.4, 0.2, 0.05};
inline std::uint8_t narrow_bits(double narrowness) {
  constexpr double almost_one = 0.97;
  if (narrowness >= almost_one) return 0;
  std::uint8_t bits = 1;
  while (bits < 7 && narrowness < narrownesses[bits])
    ++bits;
  return bits;
}

}  // namespace splotchcl
