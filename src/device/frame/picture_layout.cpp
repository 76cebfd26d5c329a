#include "device/frame/picture_layout.h"

#include <algorithm>
#include <cmath>

#include "scene/ceil_divide.h"
#include "scene/plan/grid_pyramid.h"

namespace splotchcl {
namespace {

static_assert(most_grids_of_level == MOST_BLURS);

// Pixels beside the picture that are as well known: tiles end there, and splats that are not wide
// lie there.
constexpr int beside_picture = 128;

// More digits than floats have near a splat would be lost.
constexpr int most_place_bits = 24;

// A multiple of the coarsest grid's pixels near the middle, so that it is a corner of pixels in
// every grid.
int middle_of(int size, int levels) {
  return (size / 2) >> levels << levels;
}

// As fine as 31 bits allow for all places in the picture, so that differences of two are integers
// of 32 bits.
int choose_place_bits(const Frame& frame, int middle_x, int middle_y) {
  const int farthest =
      std::max({middle_x, frame.width - middle_x, middle_y, frame.height - middle_y}) +
      beside_picture;
  int bits = most_place_bits;
  while (std::ldexp(farthest, bits) > std::ldexp(1.0, 30))
    --bits;
  return bits;
}

shared::GridPart widened(const shared::GridPart& part, int by) {
  return {part.left - by, part.top - by, part.right_end + by, part.bottom + by};
}

// What `part` of a grid is interpolated from, in pixels of the next coarser one.
shared::GridPart coarse_part(const shared::GridPart& part, int fine_guard, int coarse_guard,
                             int reach) {
  // Down also for pixels of the guard, which begin before the picture.
  const auto below = [&](int pixel) { return ((pixel - fine_guard) >> 1) + coarse_guard; };
  return widened({below(part.left), below(part.top), below(part.right_end - 1) + 1,
                  below(part.bottom - 1) + 1},
                 reach);
}

bool is_whole(const Frame& frame) {
  return frame.crop.width == frame.width && frame.crop.height == frame.height;
}

std::vector<shared::GridPart> wanted_parts(const Frame& frame, const GridPyramid& pyramid) {
  const Rectangle& crop = frame.crop;
  std::vector<shared::GridPart> wanted = {
      {crop.x, crop.y, crop.x + crop.width, crop.y + crop.height}};
  const auto guard_of = [&pyramid](std::size_t level) {
    return pyramid.grids[static_cast<std::size_t>(pyramid.level_grids[level])].guard;
  };
  for (std::size_t level = 1; level < pyramid.level_grids.size(); ++level)
    wanted.push_back(coarse_part(wanted.back(), guard_of(level - 1), guard_of(level),
                                 RefinementFilter::reach()));
  return wanted;
}

// Where splats are drawn on a grid: blurring looks at more than is wanted. All of a level but the
// picture's own have the same part, so that the check may add up their cells. `wanted` is that of
// the grid that collects the level.
shared::GridPart drawn_part(const shared::GridPart& wanted, std::size_t g, bool is_whole,
                            const GridPyramid& pyramid) {
  if (g == 0) return wanted;
  const PictureGrid& grid = pyramid.grids[g];
  // Splats find their tiles sooner where none is missing.
  if (is_whole) return {0, 0, grid.width, grid.height};
  const int collecting = pyramid.level_grids[static_cast<std::size_t>(grid.level)];
  const int shift = grid.guard - pyramid.grids[static_cast<std::size_t>(collecting)].guard;
  return widened(
      {wanted.left + shift, wanted.top + shift, wanted.right_end + shift, wanted.bottom + shift},
      reach_of_blurs(pyramid));
}

void set_tiles(const shared::GridPart& part, int tile_width, int tile_height, shared::Grid& grid) {
  grid.first_x = part.left / tile_width * tile_width;
  grid.first_y = part.top / tile_height * tile_height;
  grid.tiles_x = ceil_divide(part.right_end - grid.first_x, tile_width);
  grid.tiles_y = ceil_divide(part.bottom - grid.first_y, tile_height);
  grid.stride = static_cast<std::uint32_t>(grid.tiles_x * tile_width);
  grid.plane_size = grid.stride * static_cast<std::uint32_t>(grid.tiles_y * tile_height);
}

// Of the rows and columns before the first in memory.
int tiles_before(const shared::Grid& grid, const Variant& variant) {
  return grid.first_y / static_cast<int>(variant.tile_height) * grid.tiles_x +
         grid.first_x / static_cast<int>(variant.tile_width);
}

bool has_all_tiles(const shared::Grid& grid, const Variant& variant) {
  const auto end_x = grid.first_x + grid.tiles_x * static_cast<int>(variant.tile_width);
  const auto end_y = grid.first_y + grid.tiles_y * static_cast<int>(variant.tile_height);
  return grid.first_x == 0 && grid.first_y == 0 && end_x >= grid.width && end_y >= grid.height;
}

// Kernels number them by 32 bits.
constexpr std::uint64_t most_splats = std::uint64_t{1} << 31;

}  // namespace

shared::GridBlurs grid_blurs(const GridPyramid& pyramid) {
  shared::GridBlurs blurs{};
  while ((std::size_t{1} << blurs.shift) < pyramid.grids_of_level())
    ++blurs.shift;
  blurs.first_level = pyramid.first_level;
  for (std::size_t i = 0; i < MOST_BLURS; ++i)
    blurs.sigma2[i] = static_cast<float>(pyramid.blur_of(i + 1));
  blurs.finer_grid = static_cast<float>(pyramid.wider_for(1));
  for (std::size_t i = 0; i < pyramid.stencils.size(); ++i) {
    // Roundings of sigma beyond the widest take as little as within.
    blurs.stencil_sigma[i] = static_cast<float>(pyramid.stencils[i].largest_sigma * (1 + 1e-5));
  }
  return blurs;
}

std::vector<shared::Stencil> stencils_of_blurs(const GridPyramid& pyramid) {
  std::vector<shared::Stencil> stencils(std::max<std::size_t>(pyramid.stencils.size(), 1));
  for (std::size_t i = 0; i < pyramid.stencils.size(); ++i) {
    const Stencil& from = pyramid.stencils[i];
    stencils[i].middle = from.middle;
    stencils[i].per_width = from.per_width;
    static_assert(stencil_pixels == STENCIL_PIXELS &&
                  stencil_place_powers == STENCIL_PLACE_POWERS &&
                  stencil_width_powers == STENCIL_WIDTH_POWERS);
    std::copy(from.coefficients.begin(), from.coefficients.end(), stencils[i].coefficients);
  }
  return stencils;
}

PictureLayout make_picture_layout(const Frame& frame, const FramePlan& plan,
                                  const Variant& variant) {
  const GridPyramid& pyramid = plan.pyramid;
  const int levels = pyramid.grids.back().level;
  const int middle_x = middle_of(frame.width, levels), middle_y = middle_of(frame.height, levels);
  const int place_bits = choose_place_bits(frame, middle_x, middle_y);
  PictureLayout layout;
  layout.wanted = wanted_parts(frame, pyramid);
  for (std::size_t g = 0; g < pyramid.grids.size(); ++g) {
    const PictureGrid& from = pyramid.grids[g];
    shared::Grid grid{};
    grid.width = from.width;
    grid.height = from.height;
    grid.guard = from.guard;
    grid.middle_x = (middle_x >> from.level) + from.guard;
    grid.middle_y = (middle_y >> from.level) + from.guard;
    grid.place_bits = place_bits;
    grid.unit = std::ldexp(1.0f, -place_bits);
    // Places are rounded to floats there, twice.
    grid.room = std::ldexp(static_cast<float>(std::max(grid.width, grid.height)), -22);
    // Compositing on other grids knows center values only: coarse_sigma sees to it.
    grid.mean_sigma = g == 0 ? plan.splats.mean_sigma : 0;
    const auto level = static_cast<std::size_t>(from.level);
    set_tiles(drawn_part(layout.wanted[level], g, is_whole(frame), pyramid),
              static_cast<int>(variant.tile_width), static_cast<int>(variant.tile_height), grid);
    grid.first_tile = layout.tile_count;
    // Below 0 it wraps around, as sums with it do.
    grid.corner_tile = grid.first_tile - static_cast<std::uint32_t>(tiles_before(grid, variant));
    grid.is_part = !has_all_tiles(grid, variant);
    grid.first_float_low = static_cast<std::uint32_t>(layout.plane_floats);
    grid.first_float_high = static_cast<std::uint32_t>(layout.plane_floats >> 32);
    layout.grids.push_back(grid);
    layout.tile_count += static_cast<std::uint32_t>(grid.tiles_x * grid.tiles_y);
    layout.plane_floats += std::uint64_t{variant.planes()} * grid.plane_size;
  }
  for (std::size_t level = 1; pyramid.is_blurred() && level < pyramid.level_grids.size(); ++level) {
    shared::Grid grid = layout.grids[static_cast<std::size_t>(pyramid.level_grids[level])];
    grid.first_float_low = grid.first_float_high = 0;
    layout.collecting.push_back(grid);
  }
  return layout;
}

bool PictureLayout::has_parts() const {
  return std::any_of(grids.begin(), grids.end(),
                     [](const shared::Grid& grid) { return grid.is_part != 0; });
}

std::uint64_t counted_tiles(std::uint32_t blocks, const PictureLayout& layout) {
  return std::uint64_t{layout.has_parts() ? 2u : 1u} * blocks * layout.tile_count;
}

std::vector<shared::Grid> all_grids(const PictureLayout& layout) {
  std::vector<shared::Grid> grids = layout.grids;
  grids.insert(grids.end(), layout.collecting.begin(), layout.collecting.end());
  return grids;
}

std::uint64_t splat_slots(const Frame& frame, const FramePlan& plan, const DeviceTraits& traits) {
  std::uint64_t particles = 0;
  for (const DrawnComponent& component : frame.components) {
    const std::uint64_t count = component.particles.count, block = traits.project_block;
    particles += ceil_divide(count, block) * block;
  }
  return particles * static_cast<std::uint64_t>(plan.splats_per_particle);
}

std::uint64_t splat_capacity(const FramePlan& plan, const Variant& variant,
                             const PictureLayout& layout, const DeviceTraits& traits,
                             std::uint64_t memory) {
  constexpr std::uint64_t key = sizeof(std::uint32_t) + sizeof(std::uint16_t);
  constexpr std::uint64_t place = sizeof(std::uint32_t);
  constexpr std::uint64_t sorted_into = 2 * sizeof(std::uint32_t);
  const std::uint64_t splat = variant.splat_bytes();
  const std::uint64_t planes = layout.plane_floats * sizeof(float) * (plan.slabs > 0 ? 3 : 1);
  const std::uint64_t lists =
      traits.list_capacity * variant.tile_splat_bytes() + traits.sorted_chunk * (splat + place);
  // Of a chunk of particles, before they are put together (Projector::project_window).
  const std::uint64_t apart = std::uint64_t{traits.chunk_length()} *
                              static_cast<std::uint64_t>(plan.splats_per_particle) *
                              (splat + key + place);
  const std::uint64_t fixed = planes + lists + apart;
  const std::uint64_t room = memory > fixed ? memory - fixed : 0;
  const std::uint64_t in_room = room / (splat + key + place + sorted_into);
  // As many as a chunk has may be left over from the window before.
  const std::uint64_t in_window = in_room > traits.sorted_chunk ? in_room - traits.sorted_chunk : 0;
  const std::uint64_t in_buffer = std::min(most_splats, traits.largest_buffer / splat / 2);
  return std::max<std::uint64_t>(traits.sorted_chunk, std::min(in_window, in_buffer));
}

}  // namespace splotchcl
