#include "scene/morton_keys.h"

#include <algorithm>

namespace splotchcl {
namespace {

// Every third bit.
std::uint64_t spread_bits(std::uint64_t bits) {
  bits &= 0x1fffff;
  bits = (bits | bits << 32) & 0x1f00000000ffffU;
  bits = (bits | bits << 16) & 0x1f0000ff0000ffU;
  bits = (bits | bits << 8) & 0x100f00f00f00f00fU;
  bits = (bits | bits << 4) & 0x10c30c30c30c30c3U;
  return (bits | bits << 2) & 0x1249249249249249U;
}

}  // namespace

std::uint64_t morton_key(const std::array<double, 3>& place) {
  std::uint64_t key = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double cell = std::clamp(place[axis] * 0x1p21, 0.0, 0x1p21 - 1);
    key |= spread_bits(static_cast<std::uint64_t>(cell)) << axis;
  }
  return key;
}

// By eleven bits at a time from the lowest that differ.
void sort_by_key(std::vector<KeyedParticle>& particles) {
  std::uint64_t any = 0, all = ~std::uint64_t{0};
  for (const KeyedParticle& particle : particles) {
    any |= particle.key;
    all &= particle.key;
  }
  const std::uint64_t differing = any & ~all;
  std::vector<KeyedParticle> sorted(particles.size());
  constexpr int digit = 11;
  for (int shift = 0; shift < 3 * key_levels; shift += digit) {
    const std::uint64_t mask = (std::uint64_t{1} << digit) - 1;
    if ((differing >> shift & mask) == 0) continue;
    std::vector<std::size_t> next((std::size_t{1} << digit) + 1, 0);
    for (const KeyedParticle& particle : particles)
      ++next[(particle.key >> shift & mask) + 1];
    for (std::size_t d = 1; d < next.size(); ++d)
      next[d] += next[d - 1];
    for (const KeyedParticle& particle : particles)
      sorted[next[particle.key >> shift & mask]++] = particle;
    particles.swap(sorted);
  }
}

}  // namespace splotchcl
