#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
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

  CloudsInBlocks(const std::vector<CloudAround>&&, std::size_t, std::size_t, const Frame&) = delete;

  // Numbers of all clouds that may show in pixel (x, y), one of many that lie `spacing` pixels
  // apart, in their order. Of the others no more is lost than by their ending
  // (CloudAround::farthest2). Blocks are looked through at the first pixels that lie so close that
  // several share one. Several threads may ask.
  const std::vector<std::uint32_t>& at(int x, int y, int spacing) const;

 private:
  void look_through_blocks() const;

  const std::vector<CloudAround>& clouds_;
  const Frame& frame_;
  int columns_, rows_;  // of blocks
  std::vector<std::uint32_t> all_;
  mutable std::once_flag are_known_;
  mutable std::vector<std::vector<std::uint32_t>> of_blocks_;  // once they are
};

}  // namespace splotchcl
