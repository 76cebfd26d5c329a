#pragma once

#include <cstdint>
#include <vector>

#include "device/frame/shared.h"
#include "device/frame/specialization.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// How the plan's grids lie in device memory, cut in tiles.
struct PictureLayout {
  std::vector<shared::Grid> grids;
  std::uint32_t tile_count = 0;    // of all grids
  std::uint64_t plane_floats = 0;  // all planes of all grids
};

PictureLayout make_picture_layout(const FramePlan& plan, const Specialization& specialization);

}  // namespace splotchcl
