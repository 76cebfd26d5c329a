#include "tree/sampled_field.h"

#include <algorithm>
#include <array>

namespace splotchcl {
namespace {

constexpr unsigned digits = 11;
constexpr std::uint64_t parts = 255;

// At least `way`.
std::uint16_t stored_span(std::uint64_t way) {
  unsigned shift = 0;
  while (((way + (std::uint64_t{1} << shift) - 1) >> shift) >= std::uint64_t{1} << digits)
    ++shift;
  const std::uint64_t shifted = (way + (std::uint64_t{1} << shift) - 1) >> shift;
  return static_cast<std::uint16_t>(shift << digits | shifted);
}

std::uint64_t span_of(std::uint16_t stored) {
  return std::uint64_t{stored & ((1U << digits) - 1)} << (stored >> digits);
}

}  // namespace

SampledField SampledField::of(const float* values) {
  std::array<std::uint32_t, sampled_members> all{};
  std::transform(values, values + sampled_members, all.begin(), ordered_value);
  const auto [least, largest] = std::minmax_element(all.begin(), all.end());
  SampledField field;
  field.lowest[0] = static_cast<std::uint16_t>(*least >> 16);
  field.lowest[1] = static_cast<std::uint16_t>(*least & 0xffffU);
  field.span = stored_span(*largest - *least);
  const std::uint64_t span = span_of(field.span);
  for (std::size_t k = 0; k < sampled_members && span > 0; ++k) {
    field.members[k] = static_cast<std::uint8_t>((parts * (all[k] - *least) + span / 2) / span);
  }
  return field;
}

std::array<std::uint32_t, sampled_members> SampledField::all_ordered() const {
  const std::uint64_t least = std::uint64_t{lowest[0]} << 16 | lowest[1];
  const std::uint64_t whole = span_of(span);
  std::array<std::uint32_t, sampled_members> all{};
  for (std::size_t k = 0; k < sampled_members; ++k) {
    const std::uint64_t above = (whole * members[k] + parts / 2) / parts;
    all[k] = static_cast<std::uint32_t>(std::min<std::uint64_t>(least + above, 0xffffffffU));
  }
  return all;
}

}  // namespace splotchcl
