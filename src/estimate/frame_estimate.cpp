#include "estimate/frame_estimate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "device/frame/picture_layout.h"
#include "device/frame/variant.h"
#include "device/opencl/device_context.h"
#include "device/opencl/runtime_lock.h"
#include "estimate/device_memory.h"
#include "scene/particle_columns.h"
#include "scene/plan/cloud_sample.h"

namespace splotchcl {
namespace {

// How much there is to do for the splats of a frame.
struct SplatWork {
  double splats = 0;        // that reach the picture
  double tile_entries = 0;  // summed over the tiles that they touch
  double row_parts = 0;     // eight pixels of a row each
};

// In sigmas.
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
  double particle, extended_particle;       // projected
  double sorted;                            // splat
  double binned;                            // tile entry
  double entry;                             // composited, besides
  double fast_row, full_row, extended_row;  // eight pixels of it, by precision
  double pixel;                             // resolved
};

// Of a pixel that a slab is laid on.
constexpr double laid_pixel = 17;

constexpr Rates rates_of_sums = {11.6, 90, 0, 9, 4, 1.1, 2.3, 3, 7.2};
constexpr Rates rates_in_order = {22, 180, 13, 19, 35, 0.5, 0.9, 6, 8.3};

double row_part(const Rates& rates, Precision precision) {
  switch (precision) {
    case Precision::fast:
      return rates.fast_row;
    case Precision::full:
      return rates.full_row;
    case Precision::extended:
      return rates.extended_row;
  }
  return rates.fast_row;
}

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
                             row_part(rates, plan.precision) * work.row_parts +
                             (rates.pixel + laid_pixel * plan.slabs) * pixels;
  return 1e-9 * nanoseconds * 2 / std::max(cores, 1);
}

bool has_streamed_columns(const Frame& frame) {
  return std::any_of(
      frame.components.begin(), frame.components.end(),
      [](const DrawnComponent& component) { return has_streamed_column(component.particles); });
}

// As SplatSlices::find decides, of which particles are drawn being an estimate.
void choose_windows(const Frame& frame, const FramePlan& plan, const Variant& variant,
                    const DeviceTraits& traits, FrameEstimate& estimate) {
  const std::uint64_t capacity = splat_capacity(
      plan, variant, make_picture_layout(frame, plan, variant), traits, estimate.memory_limit);
  const bool fit = splat_slots(frame, plan, traits) <= capacity;
  if (!plan.needs_sort() || (fit && !has_streamed_columns(frame))) return;
  estimate.windows = std::max<std::uint64_t>(
      1, static_cast<std::uint64_t>(std::ceil(estimate.splats / static_cast<double>(capacity))));
  const double in_window = std::min(estimate.splats, static_cast<double>(capacity));
  estimate.device_bytes = estimate_device_bytes_of_windows(frame, plan, variant, traits, in_window);
}

std::string megabytes(std::uint64_t bytes) {
  return fmt::format("{:.3g} MB", static_cast<double>(bytes) / 1e6);
}

std::string count(double number) {
  return number < 1e5 ? fmt::format("{:.0f}", number) : fmt::format("{:.3g} million", number / 1e6);
}

// Two digits, or all before the point.
std::string rounded(double number) {
  return number < 10 ? fmt::format("{:.2g}", number) : fmt::format("{:.0f}", number);
}

}  // namespace

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
  estimate.device_bytes = estimate_device_bytes(frame, plan, variant, traits, work.splats);
  estimate.particle_bytes = particle_bytes(frame);
  estimate.splats = work.splats;
  estimate.tile_entries = work.tile_entries;
  estimate.memory_limit = memory_bytes > 0 ? memory_bytes : memory_of(chosen, traits).total;
  choose_windows(frame, plan, variant, traits, estimate);
  if (!traits.is_gpu) {
    estimate.seconds = estimate_seconds(frame, plan, work, estimate.compute_units);
  }
  return estimate;
}

std::string rounded_duration(double seconds) {
  if (seconds < 100) return rounded(seconds) + " s";
  if (seconds < 6000) return rounded(seconds / 60) + " min";
  return rounded(seconds / 3600) + " h";
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
