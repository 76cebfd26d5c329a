#include "tree/sampled_field.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tree/node_bytes.h"

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

std::uint64_t lowest_of(const SampledField& field) {
  return std::uint64_t{field.lowest[0]} << 16 | field.lowest[1];
}

// From one value to another above it; 0: that is not.
std::uint8_t stored_reach(std::uint32_t from, std::uint32_t to) {
  if (to <= from) return 0;
  const double eighths = std::ceil(8 * std::log2(static_cast<double>(to - from)));
  return static_cast<std::uint8_t>(std::clamp(eighths + 1, 1.0, 255.0));
}

std::uint64_t reach_of(std::uint8_t stored) {
  static const auto reaches =
      table_of<256>([](int b) { return b == 0 ? 0 : std::ceil(std::exp2((b - 1) / 8.0)); });
  return static_cast<std::uint64_t>(reaches[stored]);
}

}  // namespace

SampledField SampledField::of(const float* values, float least_of_all, float largest_of_all) {
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
  field.below = stored_reach(ordered_value(least_of_all), *least);
  field.above = stored_reach(*largest, ordered_value(largest_of_all));
  return field;
}

std::uint32_t SampledField::least_ordered() const {
  const std::uint64_t least = lowest_of(*this), reach = reach_of(below);
  return static_cast<std::uint32_t>(least - std::min(least, reach));
}

std::uint32_t SampledField::largest_ordered() const {
  const std::uint64_t largest = lowest_of(*this) + span_of(span) + reach_of(above);
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(largest, 0xffffffffU));
}

std::array<std::uint32_t, sampled_members> SampledField::all_ordered() const {
  const std::uint64_t least = lowest_of(*this);
  const std::uint64_t whole = span_of(span);
  std::array<std::uint32_t, sampled_members> all{};
  for (std::size_t k = 0; k < sampled_members; ++k) {
    const std::uint64_t above = (whole * members[k] + parts / 2) / parts;
    all[k] = static_cast<std::uint32_t>(std::min<std::uint64_t>(least + above, 0xffffffffU));
  }
  return all;
}

}  // namespace splotchcl
