#include "device/stages/cloud_layers.h"

#include <algorithm>

namespace splotchcl {

bool CloudLayers::has_open_before(std::uint64_t end) const {
  const std::size_t placed = splats_before_.size();
  return placed < clouds_.size() && clouds_[placed].key < end;
}

void CloudLayers::place_among(const std::vector<std::uint64_t>& keys, std::uint64_t first,
                              std::uint64_t end) {
  const auto begin = clouds_.begin() + static_cast<std::ptrdiff_t>(splats_before_.size());
  const auto open_end =
      std::lower_bound(begin, clouds_.end(), end,
                       [](const CloudAround& cloud, std::uint64_t key) { return cloud.key < key; });
  // Of each of these clouds the splats between it and the one before.
  std::vector<std::uint64_t> between(static_cast<std::size_t>(open_end - begin) + 1);
  for (const std::uint64_t key : keys) {
    const auto behind = std::lower_bound(
        begin, open_end, key,
        [](const CloudAround& cloud, std::uint64_t splat) { return cloud.key < splat; });
    ++between[static_cast<std::size_t>(behind - begin)];
  }
  for (auto cloud = begin; cloud != open_end; ++cloud) {
    first += between[static_cast<std::size_t>(cloud - begin)];
    splats_before_.push_back(first);
  }
}

std::optional<CloudLayer> CloudLayers::take_before(std::uint64_t end) {
  if (taken_ == splats_before_.size() || splats_before_[taken_] >= end) return std::nullopt;
  CloudLayer layer = {taken_, taken_, splats_before_[taken_]};
  while (layer.end < splats_before_.size() && splats_before_[layer.end] == layer.splats_before)
    ++layer.end;
  taken_ = layer.end;
  return layer;
}

}  // namespace splotchcl
