#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "device/frame/records.h"
#include "device/frame/stage_context.h"
#include "surroundings/cloud_around.h"

namespace splotchcl {

// Clouds around the camera as entries of the tiles' lists of an ordered frame: they are sorted and
// binned with the splats, and composited at their places in the order
// (kernels/composite/clouds.cl).
class CloudsInLists {
 public:
  // Whether lists can hold these clouds: in single precision, and so wide that a pixel's mean
  // follows from its center. Others are laid one by one (CloudLayers).
  static bool can_hold(const StageContext& context, const std::vector<CloudAround>& clouds);

  CloudsInLists() = default;
  // In their order.
  CloudsInLists(const StageContext& context, const std::vector<CloudAround>& clouds);

  std::size_t count() const { return keys_.size(); }
  const std::vector<std::uint64_t>& keys() const { return keys_; }
  // Puts clouds [begin, end) behind the splats, which have room for them, wherever they lie in the
  // order.
  void append(std::size_t begin, std::size_t end, KeyedSplats& keyed) const;
  const CloudTables& tables() const { return tables_; }

 private:
  const StageContext* context_ = nullptr;
  std::vector<std::uint64_t> keys_;
  CloudTables tables_;
};

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
  void append_places(const std::vector<std::uint64_t>& splats_before) {
    splats_before_.insert(splats_before_.end(), splats_before.begin(), splats_before.end());
  }
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
