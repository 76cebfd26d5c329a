#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "surroundings/cloud_around.h"

namespace splotchcl {

// Clouds [first, end) that have no splats between them, and as many in front of all of them.
struct CloudLayer {
  std::size_t first = 0, end = 0;
  std::uint64_t splats_before = 0;
};

// Clouds around the camera among the sorted splats of an ordered frame, of which keys are told
// slice by slice (KeySlice), nearest first. Of equal keys clouds lie behind splats.
class CloudLayers {
 public:
  CloudLayers() = default;
  // In their order.
  explicit CloudLayers(std::vector<CloudAround> clouds) : clouds_(std::move(clouds)) {}

  const std::vector<CloudAround>& clouds() const { return clouds_; }
  // How many splats lie before each of clouds [begin, end). Told are the keys of a slice's splats
  // that are not above the last of these clouds' keys; the slice begins with splat number `first`.
  std::vector<std::uint64_t> places_among(const std::vector<std::uint64_t>& keys,
                                          std::uint64_t first, std::size_t begin,
                                          std::size_t end) const;
  // Those of the next clouds.
  void append_places(const std::vector<std::uint64_t>& splats_before);
  // Layers in front of splat number `first` are others'.
  void skip_before(std::uint64_t first);

  // The next layer that lies in front of splat number `end` - 1, once.
  std::optional<CloudLayer> take_before(std::uint64_t end);

 private:
  std::vector<CloudAround> clouds_;
  std::vector<std::uint64_t> splats_before_;  // of those that have a place
  std::size_t taken_ = 0;
};

}  // namespace splotchcl
