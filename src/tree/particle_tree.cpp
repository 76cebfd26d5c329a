#include "tree/particle_tree.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <cstring>

#include "tree/node_bytes.h"

namespace splotchcl {
namespace {

// Of all bytes [first, end) together.
std::uint64_t bits_in(const std::uint8_t* bytes, std::uint64_t first, std::uint64_t end) {
  std::uint64_t count = 0;
  for (; first + sizeof(std::uint64_t) <= end; first += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes + first, sizeof word);
    count += std::bitset<64>(word).count();
  }
  for (; first < end; ++first)
    count += std::bitset<8>(bytes[first]).count();
  return count;
}

constexpr int parts_of_channel = 16;  // bits

}  // namespace

MeanColor MeanColor::of(const std::array<double, 3>& mean, double deviation, double dipole) {
  constexpr double least = 0x1p-120;
  MeanColor color;
  const double largest = *std::max_element(mean.begin(), mean.end());
  int exponent = 0;
  std::frexp(std::max(largest, least), &exponent);
  color.exponent = static_cast<std::int8_t>(exponent);
  for (std::size_t c = 0; c < 3; ++c) {
    color.channels[c] = static_cast<std::uint16_t>(
        std::clamp(std::round(std::ldexp(mean[c], parts_of_channel - exponent)), 0.0, 65535.0));
  }
  color.deviation = rough_bits(deviation);
  color.dipole = rough_bits(dipole);
  return color;
}

std::array<float, 3> MeanColor::mean() const {
  const float part = std::ldexp(1.0f, exponent - parts_of_channel);
  std::array<float, 3> mean{};
  for (std::size_t c = 0; c < 3; ++c)
    mean[c] = part * channels[c];
  return mean;
}

std::uint64_t TreeLevel::first_child(std::uint64_t node) const {
  return first_children[node / group] + bits_in(children, node / group * group, node);
}

std::uint64_t TreeLevel::first_loose_particle(std::uint64_t node) const {
  std::uint64_t first = first_loose[node / group];
  for (std::uint64_t before = node / group * group; before < node; ++before)
    first += loose[before];
  return first;
}

std::uint64_t TreeOfType::node_count() const {
  std::uint64_t count = 0;
  for (const TreeLevel& level : levels)
    count += level.count;
  return count;
}

}  // namespace splotchcl
