#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace splotchcl {

constexpr std::size_t sampled_members = 8;
constexpr std::size_t most_fields = 4;
using MemberValues = std::array<float, most_fields>;

// A float's bits, turned so that whole numbers have the order of the values.
inline std::uint32_t ordered_value(float value) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return (bits & 0x80000000U) != 0 ? ~bits : bits | 0x80000000U;
}
inline float value_of_ordered(std::uint32_t ordered) {
  const std::uint32_t bits = (ordered & 0x80000000U) != 0 ? ordered & 0x7fffffffU : ~ordered;
  float value = 0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

// A field's values of eight members that stand for all of a node: each for an eighth of the flux.
// They are known to a 510th of the way from the least to the largest of them, as ordered_value()
// counts it; equal ones exactly.
struct SampledField {
  std::uint16_t lowest[2] = {};  // ordered: its upper and its lower half
  std::uint16_t span = 0;        // to the largest: eleven bits, and how far they are shifted
  std::uint8_t members[sampled_members] = {};
  // How far values of other members reach beyond, rounded up to an eighth of an octave.
  std::uint8_t below = 0, above = 0;

  // All members' values lie from `least` to `largest`.
  static SampledField of(const float* values, float least, float largest);
  std::uint32_t ordered(std::size_t member) const { return all_ordered()[member]; }
  std::array<std::uint32_t, sampled_members> all_ordered() const;
  // Between these all members' values lie.
  std::uint32_t least_ordered() const;
  std::uint32_t largest_ordered() const;
};
static_assert(sizeof(SampledField) == 16);

}  // namespace splotchcl
