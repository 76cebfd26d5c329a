#include "device/stages/cloud_layers.h"

#include <algorithm>

namespace splotchcl {

std::vector<std::uint64_t> CloudLayers::places_among(const std::vector<std::uint64_t>& keys,
                                                     std::uint64_t first, std::size_t begin_cloud,
                                                     std::size_t end_cloud) const {
  std::vector<std::uint64_t> cloud_keys;
  for (std::size_t k = begin_cloud; k < end_cloud; ++k)
    cloud_keys.push_back(clouds_[k].key);
  // Of each of these clouds the splats between it and the one before, and those behind all.
  std::vector<std::uint64_t> between(cloud_keys.size() + 1);
  for (const std::uint64_t key : keys) {
    const auto behind = std::lower_bound(cloud_keys.begin(), cloud_keys.end(), key);
    ++between[static_cast<std::size_t>(behind - cloud_keys.begin())];
  }
  std::vector<std::uint64_t> places;
  for (std::size_t k = 0; k < cloud_keys.size(); ++k) {
    first += between[k];
    places.push_back(first);
  }
  return places;
}

void CloudLayers::append_places(const std::vector<std::uint64_t>& splats_before) {
  splats_before_.insert(splats_before_.end(), splats_before.begin(), splats_before.end());
}

void CloudLayers::skip_before(std::uint64_t first) {
  while (taken_ < splats_before_.size() && splats_before_[taken_] < first)
    ++taken_;
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
