#include "estimate/device_memory.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "device/frame/cell_layout.h"
#include "device/frame/chunks.h"
#include "device/frame/picture_layout.h"
#include "device/frame/shared.h"
#include "device/frame/splat_capacity.h"
#include "device/opencl/buffer_pool.h"
#include "scene/ceil_divide.h"

namespace splotchcl {
namespace {

// Of the buffers of one frame, by what they hold.
class FrameBuffers {
 public:
  FrameBuffers(const Frame& frame, const FramePlan& plan, const Variant& variant,
               const DeviceTraits& traits)
      : frame_(frame),
        plan_(plan),
        variant_(variant),
        traits_(traits),
        layout_(make_picture_layout(frame, plan, variant)) {}

  std::uint64_t planes() const { return layout_.plane_floats * sizeof(float); }

  // Of planes, and of what the check collects beside them.
  std::uint64_t light() const {
    shared::CertifyParameters cells{};
    if (plan_.has_errors_of_splats) lay_out_cells(variant_, cells);
    return planes() + std::uint64_t{layout_.tile_count} * cells.cells_per_tile * sizeof(float);
  }

  // How many leaves of a sum are held at one time.
  std::uint64_t held_leaves() const {
    const std::size_t chunks = particle_chunks(frame_, traits_).size();
    return std::max<std::size_t>(1, most_held_leaves(sum_leaves(chunks, traits_).size()));
  }

  // Of one chunk of particles, in blocks that are never filled up in part.
  std::uint64_t chunk_splats() const {
    std::uint64_t largest = 0;
    for (const DrawnComponent& component : frame_.components)
      largest = std::max<std::uint64_t>(largest, component.particles.count);
    const std::uint64_t block = traits_.project_block;
    const std::uint64_t blocks =
        std::min<std::uint64_t>(traits_.chunk_blocks, ceil_divide(largest, block));
    return blocks * block * splats_per_particle();
  }

  // Where the splats of an ordered frame lie: each particle has room for its own, block by block.
  std::uint64_t slots() const { return splat_slots(frame_, plan_, traits_); }

  std::uint64_t splats(std::uint64_t count) const { return count * variant_.splat_bytes(); }

  // Which tiles each is listed in.
  std::uint64_t tiles(std::uint64_t splats) const {
    return splats * (variant_.rows ? sizeof(std::uint32_t)
                                   : sizeof(shared::SplatTiles) + sizeof(std::uint32_t));
  }

  // The same of a chunk's, where they are not with the splats. Of a GPU where these lie as well.
  std::uint64_t tiles_of_chunk() const {
    const std::uint64_t order = variant_.rows ? 0 : chunk_splats() * sizeof(std::uint32_t);
    return order + (variant_.has_own_tiles() ? 0 : tiles(chunk_splats()));
  }

  // Splats that were put in order for their lists; only by the shape for processors.
  std::uint64_t splats_in_order(std::uint64_t count) const {
    return (variant_.rows ? count * variant_.splat_bytes() : 0) + tiles(count);
  }

  // Of the lists of as many tiles as fit.
  std::uint64_t entries() const {
    return entry_capacity(plan_, traits_) * variant_.tile_splat_bytes();
  }

  // Counts per tile of each block, and the lists.
  std::uint64_t lists(std::uint64_t blocks) const {
    const std::uint64_t capacity = entry_capacity(plan_, traits_);
    const std::uint64_t segments = layout_.tile_count + capacity / traits_.segment_length + 1;
    // Of a GPU: tiles and splats of all entries, from where and to where they are sorted.
    const std::uint64_t pairs = variant_.rows ? 0 : 4 * sizeof(std::uint32_t);
    const std::uint64_t of_blocks = (layout_.has_parts() ? 2 : 1) * blocks;
    const std::uint64_t counts = variant_.rows ? of_blocks + 2 : 2 * COPIES_OF_COUNTS;
    return counts * layout_.tile_count * sizeof(std::uint32_t) +
           segments * sizeof(shared::Segment) + entries() + capacity * pairs;
  }

  // What levels are blurred and refined to, by turns.
  std::uint64_t collecting_levels() const {
    std::uint64_t largest = 0;
    for (const shared::Grid& grid : layout_.collecting)
      largest = std::max<std::uint64_t>(largest, grid.plane_size);
    const std::uint64_t rooms = std::min<std::uint64_t>(layout_.collecting.size(), 2);
    return rooms * largest * variant_.planes() * sizeof(float);
  }

  // What a grid's rows are blurred or refined into.
  std::uint64_t blurred_columns() const {
    std::uint64_t largest = 0;
    for (std::size_t g = 1; g < layout_.grids.size(); ++g) {
      const shared::Grid& coarse = layout_.grids[g];
      const std::uint64_t width = std::max(coarse.stride + 8, layout_.grids[g - 1].stride);
      largest = std::max(largest, width * (coarse.plane_size / coarse.stride));
    }
    return largest * variant_.planes() * sizeof(float);
  }

  // The planes before a slab, and what its grids are refined into. The errors are an eighth of a
  // plane.
  std::uint64_t slabs() const {
    if (plan_.slabs == 0) return 0;
    const std::uint64_t plane = layout_.grids.front().plane_size * sizeof(float);
    return variant_.planes() * plane + plane / 8 + blurred_columns() + collecting_levels();
  }

  std::uint64_t blocks_of_chunk() const {
    return chunk_splats() / (std::uint64_t{traits_.project_block} * splats_per_particle());
  }

 private:
  std::uint64_t splats_per_particle() const {
    return static_cast<std::uint64_t>(plan_.splats_per_particle);
  }

  const Frame& frame_;
  const FramePlan& plan_;
  const Variant& variant_;
  const DeviceTraits& traits_;
  const PictureLayout layout_;
};

// Of two that are not needed together, where memory of the one seldom serves for the other: what
// lies idle is kept as far as the pool keeps it.
std::uint64_t bytes_held(std::uint64_t first, std::uint64_t then, const DeviceTraits& traits) {
  const std::uint64_t idle = traits.shares_host_memory ? BufferPool::idle_on_processors : 0;
  return std::max(first, then) + std::min({first, then, idle});
}

std::uint64_t bytes_for_sums(const FrameBuffers& buffers, const DeviceTraits& traits) {
  const std::uint64_t drawing = buffers.splats(buffers.chunk_splats()) + buffers.tiles_of_chunk() +
                                buffers.lists(buffers.blocks_of_chunk());
  return buffers.held_leaves() * buffers.light() + buffers.collecting_levels() +
         bytes_held(drawing, buffers.blurred_columns(), traits);
}

constexpr std::uint64_t key = sizeof(std::uint32_t), order = sizeof(std::uint32_t);

std::uint64_t key_end_of(const Frame& frame) {
  return frame.sort.by == SortOrder::By::depth ? sizeof(std::uint16_t) : 0;
}

// While sorted splats are drawn, without these.
std::uint64_t bytes_of_drawing(const FrameBuffers& buffers, const DeviceTraits& traits,
                               std::uint64_t count) {
  const std::uint64_t chunk = std::min<std::uint64_t>(count, traits.sorted_chunk);
  return count * order + buffers.splats_in_order(chunk) + buffers.lists(traits.bin_blocks) +
         buffers.slabs();
}

// Keys and order have a second place each, where they are sorted to: of keys the one that they were
// projected to.
std::uint64_t bytes_in_order(const FrameBuffers& buffers, const Frame& frame,
                             const DeviceTraits& traits, double splats) {
  const auto count = static_cast<std::uint64_t>(std::llround(splats));
  const std::uint64_t slots = buffers.slots();
  const std::uint64_t sorting = slots * (key_end_of(frame) + key) + count * (key + 2 * order);
  return buffers.light() + buffers.splats(slots) +
         std::max(sorting, bytes_of_drawing(buffers, traits, count));
}

// What the window before has left of a chunk comes on top of a window's own.
std::uint64_t bytes_in_windows(const FrameBuffers& buffers, const Frame& frame,
                               const DeviceTraits& traits, double splats) {
  const auto own = static_cast<std::uint64_t>(std::llround(splats));
  const std::uint64_t count = own + std::min<std::uint64_t>(own, traits.sorted_chunk);
  const std::uint64_t keyed = key + key_end_of(frame) + order, apart = buffers.chunk_splats();
  const std::uint64_t projecting = count * keyed + buffers.splats(apart) + apart * keyed;
  const std::uint64_t sorting = count * (keyed + key + order);
  return buffers.light() + buffers.splats(count) +
         std::max({projecting, sorting, bytes_of_drawing(buffers, traits, count)});
}

}  // namespace

std::uint64_t particle_bytes(const Frame& frame) {
  std::uint64_t values = 0;
  for (const DrawnComponent& component : frame.components) {
    const Particles& p = component.particles;
    for (const Column* column : {&p.position, &p.smoothing_length, &p.weight, &p.color,
                                 &p.color_vector, &p.intensity, &p.sort_field}) {
      values += column->size();
    }
  }
  return values * sizeof(float);
}

std::uint64_t estimate_device_bytes(const Frame& frame, const FramePlan& plan,
                                    const Variant& variant, const DeviceTraits& traits,
                                    double splats) {
  const FrameBuffers buffers(frame, plan, variant, traits);
  const std::uint64_t uploaded = traits.shares_host_memory ? 0 : particle_bytes(frame);
  return uploaded + (plan.needs_sort() ? bytes_in_order(buffers, frame, traits, splats)
                                       : bytes_for_sums(buffers, traits));
}

std::uint64_t estimate_device_bytes_of_windows(const Frame& frame, const FramePlan& plan,
                                               const Variant& variant, const DeviceTraits& traits,
                                               double splats) {
  const FrameBuffers buffers(frame, plan, variant, traits);
  const std::uint64_t uploaded = traits.shares_host_memory ? 0 : particle_bytes(frame);
  return uploaded + bytes_in_windows(buffers, frame, traits, splats);
}

}  // namespace splotchcl
