#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "device/frame/chunks.h"
#include "device/frame/shared.h"
#include "device/opencl/buffer_pool.h"

// What the stages hand on. Each owns its memory, which goes back to the pool with it. Splats have
// Variant::splat_bytes() each.
namespace splotchcl {

// One chunk of particles, projected: block b begins at slot b * stride and holds as many
// splats as counts[b] says.
struct SplatBlocks {
  Buffer<std::byte> splats;
  Buffer<shared::BlockCounts> counts;
  // What binning begins with, and takes (tiles.cl): how many splats of each block touch each tile;
  // and per slot, which tiles these are.
  Buffer<std::uint32_t> tile_counts;
  Buffer<std::uint32_t> tiles;
  // In the shape for GPUs, which bins them one by one: where they lie.
  Buffer<std::uint32_t> order;
  std::uint32_t visible = 0;
  std::uint32_t block_count = 0;
  std::uint32_t stride = 0;
  std::uint32_t left_out = 0;  // blocks out of view
};

// What became of particles.
struct ParticleCounts {
  std::uint64_t visible = 0, bad = 0;
  std::uint64_t too_sharp = 0;             // for the frame's precision, in the whole picture
  std::uint64_t around = 0;                // the camera: not among the splats
  std::vector<ChunkBlocks> chunks_around;  // where those may be

  ParticleCounts& operator+=(const ParticleCounts& more) {
    visible += more.visible;
    bad += more.bad;
    too_sharp += more.too_sharp;
    around += more.around;
    chunks_around.insert(chunks_around.end(), more.chunks_around.begin(), more.chunks_around.end());
    return *this;
  }
};

// All splats of a frame in component and file order, with their sort keys, which have no gaps.
struct KeyedSplats {
  Buffer<std::byte> splats;
  Buffer<std::uint32_t> keys;      // their upper 32 bits
  Buffer<std::uint16_t> key_ends;  // slot by slot the 16 bits below; none where a field is the key
  Buffer<std::uint32_t> order;     // the slot of splat i: i, or farther behind
  Buffer<std::uint32_t> scratch;   // as long as `order`, for sorting; none: the sorter takes some
  std::uint32_t count = 0;
  // Slots that hold no splat, for as many as there are particles around the camera; none: slots
  // from `count` on are free.
  std::vector<std::uint32_t> free_slots;
  std::uint32_t left_out = 0;  // blocks out of view
  ParticleCounts particles;
};

// The same, nearest first: splat order[0], order[1], ...
struct SortedSplats {
  Buffer<std::byte> splats;
  Buffer<std::uint32_t> order;
  std::uint32_t count = 0;
};

// A range of tiles, numbered through all grids, row by row.
struct TileBand {
  std::uint32_t first = 0, end = 0;
};

// The lists of one chunk of splats in a band of tiles. Entries have
// Variant::tile_splat_bytes() each.
struct TileLists {
  Buffer<std::byte> entries;
  Buffer<shared::Segment> segments;
  std::uint64_t entry_count = 0;
  std::uint32_t segment_count = 0;
  std::uint32_t picture_segments = 0;  // the first ones, of the picture's own grid
  std::uint32_t partial_count = 0;     // segments of tiles that were cut
  std::uint32_t used_grids = 0;        // bit g: grid g has entries
};

// The light of all grids, as PictureLayout places it.
struct Planes {
  Buffer<float> light;
  std::uint32_t used_grids = 0;  // bit g: grid g has light; the planes of others are undefined
};

// Where grids are brought to the picture's own: what one level after the other is blurred and
// interpolated to, by turns, and what each step makes along one axis.
struct CollectingRoom {
  std::array<Buffer<float>, 2> levels;
  Buffer<float> columns;
};

// What slabs of an ordered frame add to its planes.
struct SlabLight {
  Buffer<float> before;  // the picture's own planes as they were before this slab
  // Of eight pixels of a row each: what any order of the slabs' splats could change at most.
  Buffer<float> errors;
  CollectingRoom room;
};

// What splats of a sum, or the nearest of an ordered frame, have come to: their light, and what the
// check needs of them (Certifier).
struct SplatLight {
  Planes planes;
  Buffer<float> cells;  // none where nothing has been collected
  SlabLight slab;       // none where there are no slabs
};

// What lists need of the clouds around the camera that are among them (clouds.cl).
struct CloudTables {
  Buffer<shared::CloudEntry> entries;
  Buffer<shared::CloudSplat> splats;
  // Of each pixel of the picture's grid in memory, as its planes lie; and of its tiles.
  Buffer<float> directions;
  Buffer<shared::DirectionCone> cones;
};

}  // namespace splotchcl
