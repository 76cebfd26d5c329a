#pragma once

#include <cstdint>
#include <optional>

#include "splotchcl/frame.h"

namespace splotchcl {

// Frames of a tree's nodes for quick looks: of as many splats as there is time for, whatever they
// err by. From frame to frame what fits is found from what fitted before.
class TreePreview {
 public:
  // At most so many splats, and mostly half of them or more, where there are as many particles.
  // Pixels have a footprint of half a pixel at least. Nothing where no tree serves all components,
  // or too many particles are near the camera.
  std::optional<Frame> of(const Frame& frame, std::uint64_t most_splats);

 private:
  double error_ = 1;  // of the last cut that fitted
};

}  // namespace splotchcl
