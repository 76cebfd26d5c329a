#include "device/frame/key_parts.h"

#include <algorithm>
#include <cmath>

#include "device/frame/key_windows.h"
#include "device/frame/shared.h"

namespace splotchcl {
namespace {

// Sampled splats of each part: fewer would not tell how many splats it has.
constexpr double fewest_sampled = 4;
// Of the sample at each end, which do not widen the bins.
constexpr double far_off = 0.005;
// A part is sorted by one thread, so it may have no more than this of all splats.
constexpr double largest_part = 1.0 / 16;

std::uint32_t upper_bits(std::uint64_t key) {
  return static_cast<std::uint32_t>(key >> (bits_of_key - 32));
}

std::size_t bin_of(std::uint64_t key, const KeyParts& parts) {
  const std::uint32_t upper = upper_bits(key);
  const std::uint32_t above = upper > parts.first_key ? upper - parts.first_key : 0;
  return std::min<std::size_t>(above >> parts.shift, KEY_PART_BINS - 1);
}

// Bins around nearly all of the sample.
KeyParts bins_around(const std::vector<std::uint64_t>& sampled_keys) {
  const auto beside = static_cast<std::size_t>(far_off * static_cast<double>(sampled_keys.size()));
  KeyParts parts;
  parts.first_key = upper_bits(sampled_keys[beside]);
  const std::uint32_t range =
      upper_bits(sampled_keys[sampled_keys.size() - 1 - beside]) - parts.first_key;
  while (range >> parts.shift >= KEY_PART_BINS)
    ++parts.shift;
  return parts;
}

}  // namespace

std::optional<KeyParts> choose_key_parts(const std::vector<std::uint64_t>& sampled_keys,
                                         double expected_splats, const DeviceTraits& traits) {
  const auto sampled = static_cast<double>(sampled_keys.size());
  const double wanted =
      std::floor(std::min({static_cast<double>(most_key_parts),
                           expected_splats / traits.splats_of_part, sampled / fewest_sampled}));
  if (!(wanted >= traits.fewest_parts)) return std::nullopt;
  KeyParts parts = bins_around(sampled_keys);
  std::vector<std::size_t> sampled_in_bin(KEY_PART_BINS);
  for (const std::uint64_t key : sampled_keys)
    ++sampled_in_bin[bin_of(key, parts)];

  std::size_t before = 0, in_part = 0;
  double next = 0;  // sampled splats before the next part
  for (std::size_t bin = 0; bin < KEY_PART_BINS; ++bin) {
    const std::uint64_t first = parts.first_key + (std::uint64_t{bin} << parts.shift);
    const bool has_more = before < sampled_keys.size() && parts.parts.size() < most_key_parts;
    if (has_more && static_cast<double>(before) >= next) {
      if (!parts.parts.empty()) parts.parts.back().end = first;
      parts.parts.push_back({first, first});
      next = static_cast<double>(before) + sampled / wanted;
      in_part = 0;
    }
    parts.part_of_bin.push_back(static_cast<std::uint8_t>(parts.parts.size() - 1));
    before += sampled_in_bin[bin];
    in_part += sampled_in_bin[bin];
    if (static_cast<double>(in_part) > sampled * largest_part + fewest_sampled) return std::nullopt;
  }
  // With those beside all bins.
  parts.parts.front().first = upper_bits(sampled_keys.front());
  parts.parts.back().end = std::uint64_t{upper_bits(sampled_keys.back())} + 1;
  return parts;
}

std::optional<KeyParts> choose_key_parts(const Frame& frame, const FramePlan& plan,
                                         const DeviceTraits& traits) {
  const bool is_possible =
      traits.rows && plan.needs_sort() && !plan.is_extended() && !plan.has_copies;
  if (!is_possible) return std::nullopt;
  const double expected = plan.visible_part * static_cast<double>(particle_count(frame));
  return choose_key_parts(plan.sampled_keys, expected, traits);
}

std::uint32_t blocks_apart(const DeviceTraits& traits) {
  constexpr std::uint32_t of_thread = 4;
  return std::max(traits.blocks_apart, of_thread * traits.threads);
}

std::uint32_t parts_at_a_time(const DeviceTraits& traits) {
  constexpr std::uint32_t of_thread = 4;
  return of_thread * traits.threads;
}

}  // namespace splotchcl
