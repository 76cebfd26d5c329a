#pragma once

#include <cstddef>
#include <cstdint>
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

}  // namespace splotchcl
