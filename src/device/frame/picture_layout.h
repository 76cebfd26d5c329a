#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "device/frame/shared.h"
#include "device/frame/variant.h"
#include "device/opencl/device_traits.h"
#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// How the plan's grids lie in device memory, cut in tiles. Pixels and tiles are the whole
// picture's, and of each grid those tiles are in memory that the crop needs, so that it has the
// picture's bits.
struct PictureLayout {
  std::vector<shared::Grid> grids;
  // Of each level, in its pixels: what finer levels are interpolated from; of level 0 the crop.
  std::vector<shared::GridPart> wanted;
  // What all grids of a level are blurred to, of each level from 1 on: as its grids lie, in memory
  // of its own. None where nothing is blurred.
  std::vector<shared::Grid> collecting;
  std::uint32_t tile_count = 0;    // of all grids
  std::uint64_t plane_floats = 0;  // all planes of all grids

  bool has_parts() const;  // of some grid's tiles not all are in memory
};

// How many counts of tiles so many blocks of splats have (kernels/bin/tiles.cl, CountedTiles).
std::uint64_t counted_tiles(std::uint32_t blocks, const PictureLayout& layout);

// Where the grid's planes begin, one after the other, in floats.
inline std::size_t floats_before(const shared::Grid& grid) {
  return grid.first_float_low | std::size_t{grid.first_float_high} << 32;
}

PictureLayout make_picture_layout(const Frame& frame, const FramePlan& plan,
                                  const Variant& variant);

// As kernels number them: first those that splats are drawn on, then those that collect levels.
std::vector<shared::Grid> all_grids(const PictureLayout& layout);

// What kernels know of the blurs.
shared::GridBlurs grid_blurs(const GridPyramid& pyramid);

// Of each blur; one of zeros where there are none.
std::vector<shared::Stencil> stencils_of_blurs(const GridPyramid& pyramid);

// The most splats of an ordered frame that have room in `memory` bytes at one time, with their
// keys, beside the picture's planes and the lists of a chunk. No less than a chunk's, whatever room
// there is.
std::uint64_t splat_capacity(const FramePlan& plan, const Variant& variant,
                             const PictureLayout& layout, const DeviceTraits& traits,
                             std::uint64_t memory);

// The slots of an ordered frame's splats, drawn in one piece: each block of particles has room for
// the splats of all of its particles (Projector).
std::uint64_t splat_slots(const Frame& frame, const FramePlan& plan, const DeviceTraits& traits);

}  // namespace splotchcl
