#include "estimate/frame_estimate.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "device/frame/chunks.h"
#include "device/frame/picture_layout.h"
#include "device/frame/shared.h"
#include "device/frame/variant.h"
#include "device/opencl/buffer_pool.h"
#include "device/opencl/device_context.h"
#include "device/opencl/runtime_lock.h"
#include "device/stages/certifier.h"
#include "scene/ceil_divide.h"
#include "scene/particle_columns.h"
#include "scene/plan/cloud_sample.h"

namespace splotchcl {
namespace {

class FrameBuffers {
 public:
  FrameBuffers(const Frame& frame, const FramePlan& plan, const Variant& variant,
               const DeviceTraits& traits)
      : frame_(frame),
        plan_(plan),
        variant_(variant),
        traits_(traits),
        layout_(make_picture_layout(frame, plan, variant)) {}

  std::uint64_t for_sums() const {
    const std::uint64_t blocks =
        chunk_splats() / (std::uint64_t{traits_.project_block} * splats_per_particle());
    const std::uint64_t drawing = splats(chunk_splats()) + tiles_of_chunk() + lists(blocks);
    return held_leaves() * light() + collecting_levels() + held(drawing, blurred_columns());
  }
  // Keys and order have a second place each, where they are sorted to: of keys the one that they
  // were projected to.
  std::uint64_t in_order(std::uint64_t count) const {
    // Each particle has room for its own, block by block.
    const std::uint64_t slots = splat_slots(frame_, plan_, traits_);
    const std::uint64_t sorting = slots * (key_end() + key) + count * (key + 2 * order);
    return light() + splats(slots) + std::max(sorting, of_drawing(count));
  }
  // What the window before has left of a chunk comes on top of a window's own.
  std::uint64_t in_windows(std::uint64_t own) const {
    const std::uint64_t count = own + std::min<std::uint64_t>(own, traits_.sorted_chunk);
    const std::uint64_t keyed = key + key_end() + order, apart = chunk_splats();
    const std::uint64_t projecting = count * keyed + splats(apart) + apart * keyed;
    const std::uint64_t sorting = count * (keyed + key + order);
    return light() + splats(count) + std::max({projecting, sorting, of_drawing(count)});
  }

 private:
  static constexpr std::uint64_t key = sizeof(std::uint32_t), order = sizeof(std::uint32_t);

  std::uint64_t key_end() const {
    return frame_.sort.by == SortOrder::By::depth ? sizeof(std::uint16_t) : 0;
  }
  // Of two that are not needed together, where memory of the one seldom serves for the other: what
  // lies idle is kept as far as the pool keeps it.
  std::uint64_t held(std::uint64_t first, std::uint64_t then) const {
    const std::uint64_t idle = traits_.shares_host_memory ? BufferPool::idle_on_processors : 0;
    return std::max(first, then) + std::min({first, then, idle});
  }
  // While sorted splats are drawn, without these.
  std::uint64_t of_drawing(std::uint64_t count) const {
    const std::uint64_t chunk = std::min<std::uint64_t>(count, traits_.sorted_chunk);
    return count * order + splats_in_order(chunk) + lists(traits_.bin_blocks) + slabs();
  }

  // Of planes, and of what the check collects beside them.
  std::uint64_t light() const {
    shared::CertifyParameters cells{};
    if (plan_.has_errors_of_splats) lay_out_cells(variant_, cells);
    return (layout_.plane_floats + std::uint64_t{layout_.tile_count} * cells.cells_per_tile) *
           sizeof(float);
  }

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

  std::uint64_t splats(std::uint64_t count) const { return count * variant_.splat_bytes(); }

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

  std::uint64_t splats_per_particle() const {
    return static_cast<std::uint64_t>(plan_.splats_per_particle);
  }

  const Frame& frame_;
  const FramePlan& plan_;
  const Variant& variant_;
  const DeviceTraits& traits_;
  const PictureLayout layout_;
};

struct SplatWork {
  double splats = 0;        // that reach the picture
  double tile_entries = 0;  // summed over the tiles that they touch
  double row_parts = 0;     // eight pixels of a row each
};

double extent_of(const SampledCloud& cloud, const Frame& frame, const FramePlan& plan) {
  if (frame.kernel.cut) return *frame.kernel.cut;
  const double edge = cloud.light * static_cast<double>(plan.splats.inverse_edge);
  return std::max(static_cast<double>(plan.splats.least_extent),
                  std::sqrt(std::log(std::max(edge, 1.0))));
}

std::size_t grid_of(const SampledCloud& cloud, const FramePlan& plan) {
  const std::size_t grids = plan.pyramid.grids.size();
  const double octaves = std::log2(plan.pyramid.over_least_width(cloud.sigma, cloud.light));
  const auto of_level = static_cast<double>(plan.pyramid.grids_of_level());
  const double index = std::floor(of_level * (octaves - plan.pyramid.first_level)) + 1;
  return static_cast<std::size_t>(std::clamp(index, 0.0, static_cast<double>(grids - 1)));
}

// Of the part of [middle - reach, middle + reach] that lies in [first, first + length].
double length_inside(double middle, double reach, int first, int length) {
  const double begin = std::max(middle - reach, static_cast<double>(first));
  const double end = std::min(middle + reach, static_cast<double>(first) + length);
  return std::max(end - begin, 0.0);
}

// From a sample of the particles, with the plan's extents and grids, as kernels/project/limits.cl
// chooses them. Tiles that become opaque early are counted as if they did not.
SplatWork estimate_splat_work(const Frame& frame, const FramePlan& plan, const Variant& variant) {
  SplatWork work;
  for (const SampledCloud& cloud : sample_clouds(frame)) {
    const std::size_t g = grid_of(cloud, plan);
    const double pixel = std::exp2(plan.pyramid.grids[g].level);
    double sigma = cloud.sigma / pixel;
    const bool is_stencil = g > 0 && plan.pyramid.has_stencils() && cloud.light <= 1;
    if (g > 0 && plan.pyramid.is_blurred() && !is_stencil)
      sigma = std::sqrt(std::max(sigma * sigma - plan.pyramid.blur_of(g), 0.25));
    const double half_stencil = static_cast<double>(stencil_pixels) / 2;
    const double reach =
        (is_stencil ? half_stencil : extent_of(cloud, frame, plan) * sigma) * pixel;
    const Rectangle& crop = frame.crop;
    const double width = length_inside(cloud.x, reach, crop.x, crop.width) / pixel;
    const double height = length_inside(cloud.y, reach, crop.y, crop.height) / pixel;
    const double tiles = (1 + width / variant.tile_width) * (1 + height / variant.tile_height);
    work.splats += cloud.weight;
    work.tile_entries += cloud.weight * tiles;
    work.row_parts += cloud.weight * (1 + height) * (1 + width / 8);
  }
  return work;
}

// Nanoseconds on two cores.
struct Rates {
  double particle, extended_particle;  // projected
  double sorted;                       // splat
  double binned;                       // tile entry
  double entry;                        // composited, besides
  std::array<double, 3> row;           // eight pixels of it, by precision
  double pixel;                        // resolved
};

// Of a pixel that a slab is laid on.
constexpr double laid_pixel = 17;

constexpr Rates rates_of_sums = {11.6, 90, 0, 9, 4, {1.1, 2.3, 3}, 7.2};
constexpr Rates rates_in_order = {22, 180, 13, 19, 35, {0.5, 0.9, 6}, 8.3};

// Seconds on a processor with as many cores, at rates that were measured on two cores of an AMD
// EPYC through PoCL 3.1 (docs/dev/performance.md, Estimates).
double estimate_seconds(const Frame& frame, const FramePlan& plan, const SplatWork& work,
                        int cores) {
  const Rates& rates = plan.needs_sort() ? rates_in_order : rates_of_sums;
  const double pixels =
      static_cast<double>(frame.crop.width) * static_cast<double>(frame.crop.height);
  const double nanoseconds = (plan.is_extended() ? rates.extended_particle : rates.particle) *
                                 static_cast<double>(particle_count(frame)) +
                             rates.sorted * work.splats +
                             (rates.binned + rates.entry) * work.tile_entries +
                             rates.row[static_cast<std::size_t>(plan.precision)] * work.row_parts +
                             (rates.pixel + laid_pixel * plan.slabs) * pixels;
  return 1e-9 * nanoseconds * 2 / std::max(cores, 1);
}

bool has_streamed_columns(const Frame& frame) {
  return std::any_of(
      frame.components.begin(), frame.components.end(),
      [](const DrawnComponent& component) { return has_streamed_column(component.particles); });
}

// As SplatSlices::find decides, of which particles are drawn being an estimate.
void estimate_memory(const Frame& frame, const FramePlan& plan, const Variant& variant,
                     const DeviceTraits& traits, FrameEstimate& estimate) {
  const FrameBuffers buffers(frame, plan, variant, traits);
  const auto whole = [](double splats) { return static_cast<std::uint64_t>(std::llround(splats)); };
  const std::uint64_t capacity = splat_capacity(
      plan, variant, make_picture_layout(frame, plan, variant), traits, estimate.memory_limit);
  const bool fit = splat_slots(frame, plan, traits) <= capacity && !has_streamed_columns(frame);
  if (!plan.needs_sort()) {
    estimate.device_bytes = buffers.for_sums();
  } else if (fit) {
    estimate.device_bytes = buffers.in_order(whole(estimate.splats));
  } else {
    const auto most = static_cast<double>(capacity);
    estimate.windows =
        std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::ceil(estimate.splats / most)));
    estimate.device_bytes = buffers.in_windows(whole(std::min(estimate.splats, most)));
  }
  if (!traits.shares_host_memory) estimate.device_bytes += estimate.particle_bytes;
}

std::string megabytes(std::uint64_t bytes) {
  return fmt::format("{:.3g} MB", static_cast<double>(bytes) / 1e6);
}

std::string count(double number) {
  return number < 1e5 ? fmt::format("{:.0f}", number) : fmt::format("{:.3g} million", number / 1e6);
}

std::string rounded(double number) {
  return number < 10 ? fmt::format("{:.2g}", number) : fmt::format("{:.0f}", number);
}

// "0.12 s", "3.4 min", "2.1 h".
std::string rounded_duration(double seconds) {
  if (seconds < 100) return rounded(seconds) + " s";
  if (seconds < 6000) return rounded(seconds / 60) + " min";
  return rounded(seconds / 3600) + " h";
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

FrameEstimate estimate_frame(const Frame& frame, const FramePlan& plan, const std::string& device,
                             std::uint64_t memory_bytes) {
  const auto lock = lock_runtime();
  const compute::device chosen = choose_device(device);
  const DeviceTraits traits = traits_of(chosen);
  const Variant variant(frame, plan, traits);
  const SplatWork work = estimate_splat_work(frame, plan, variant);
  FrameEstimate estimate;
  estimate.device = chosen.name();
  estimate.compute_units = static_cast<int>(chosen.compute_units());
  estimate.particle_bytes = particle_bytes(frame);
  estimate.splats = work.splats;
  estimate.tile_entries = work.tile_entries;
  estimate.memory_limit = memory_bytes > 0 ? memory_bytes : memory_of(chosen, traits).total;
  estimate_memory(frame, plan, variant, traits, estimate);
  if (!traits.is_gpu) {
    estimate.seconds = estimate_seconds(frame, plan, work, estimate.compute_units);
  }
  return estimate;
}

std::string explain(const FrameEstimate& estimate, int drawings) {
  std::string text = fmt::format(
      "memory: {} of buffers on the device, for the plan's chunks, lists and grids; {} of "
      "particles\n",
      megabytes(estimate.device_bytes), megabytes(estimate.particle_bytes));
  if (estimate.windows > 0) {
    text +=
        fmt::format("  drawn in about {} windows of depth, since there is room for {} (--memory)\n",
                    estimate.windows, megabytes(estimate.memory_limit));
  }
  if (!estimate.seconds) {
    return text + "time: no estimate, since no rates were measured on a GPU\n";
  }
  const std::string each = drawings > 1 ? fmt::format(" ({} drawings, {} each)", drawings,
                                                      rounded_duration(*estimate.seconds))
                                        : std::string();
  text += fmt::format("time: about {} to draw{}, an estimate\n",
                      rounded_duration(drawings * *estimate.seconds), each);
  text += fmt::format(
      "  {} splats in {} entries of tiles, at rates that were measured on two cores of an\n"
      "  AMD EPYC through PoCL 3.1, for the {} compute units of {};\n"
      "  without reading, compiling kernels and writing\n",
      count(estimate.splats), count(estimate.tile_entries), estimate.compute_units,
      estimate.device);
  return text;
}

}  // namespace splotchcl
