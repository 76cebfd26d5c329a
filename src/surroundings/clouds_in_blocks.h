#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "surroundings/cloud_around.h"

namespace splotchcl {

// Which clouds around the camera show in which part of the picture. A cloud shows in all directions
// only where the camera is in it: of those that are many sigma away a pixel has a small part.
class CloudsInBlocks {
 public:
  // Of clouds [first, end).
  CloudsInBlocks(const std::vector<CloudAround>& clouds, std::size_t first, std::size_t end,
                 const Frame& frame);

  // Numbers of all clouds that may show in pixel (x, y), in their order. Of the others no more is
  // lost than by their ending (CloudAround::farthest2).
  const std::vector<std::uint32_t>& at(int x, int y) const;

 private:
  int columns_, rows_;  // of blocks
  std::vector<std::vector<std::uint32_t>> of_blocks_;
  std::vector<std::uint32_t> all_;
};

}  // namespace splotchcl
