#include "frame_counts.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "device/opencl/device_context.h"
#include "device/pipeline.h"
#include "estimate/frame_estimate.h"
#include "splotchcl/plan.h"

namespace splotchcl::bench {
namespace {

// Pixels whose centers lie within `reach` of a place, of so many around the middle of a tile.
double pixels_within(double place, double reach, double size) {
  const double first = std::max(-size / 2, std::ceil(place - reach - 0.5));
  const double last = std::min(size / 2 - 1, std::floor(place + reach - 0.5));
  return std::max(0.0, last - first + 1);
}

// Squares of how near the nearest pixel's center of each of a tile's strips, so many pixels wide,
// is to a place.
std::vector<double> nearest_squares(double place, double size, double strip) {
  std::vector<double> squares;
  for (double first = 0; first < size; first += strip) {
    const double low = first + 0.5 - size / 2 - place, high = low + strip - 1;
    const double nearest = std::max({0.0, low, -high});
    squares.push_back(nearest * nearest);
  }
  return squares;
}

constexpr double widest_without_patches = 7;

// Makes the lists of a frame one after the other, and looks at what they hold.
class ListReader {
 public:
  ListReader(DeviceContext& device, const Frame& frame, const FramePlan& plan)
      : device_(device), plan_(plan), store_(device), pipeline_(device, store_, frame, plan) {}

  void read(FrameCounts& counts) {
    if (plan_.needs_sort()) {
      read_ordered(counts);
    } else {
      read_sums(counts);
    }
    device_.queue.finish();
    device_.timer.clear();
  }

 private:
  const Variant& variant() const { return pipeline_.context().variant; }

  void read_sums(FrameCounts& counts) {
    for (const ParticleChunk& chunk : pipeline_.particle_chunks()) {
      SplatBlocks blocks = pipeline_.project(chunk);
      read_lists(pipeline_.binner().count(blocks), counts);
      ++counts.chunks;
    }
  }

  void read_ordered(FrameCounts& counts) {
    const SortedSplats sorted = pipeline_.sorter().sort(pipeline_.project_all());
    for (const SplatChunk& chunk : splat_chunks(sorted.count, plan_.slabs, device_.traits)) {
      read_lists(pipeline_.binner().count(sorted, chunk), counts);
      ++counts.chunks;
    }
  }

  void read_lists(const CountedSplats& counted, FrameCounts& counts) {
    for (const TileBand& band : counted.bands) {
      const TileLists lists = pipeline_.binner().make_lists(counted, band);
      const std::size_t entry_bytes = variant().tile_splat_bytes();
      const std::vector<std::byte> entries =
          device_.pool.download(lists.entries, lists.entry_count * entry_bytes);
      const std::byte* entry = entries.data();
      for (std::uint32_t tile = band.first; tile < band.end; ++tile) {
        ListWork& work = is_layered(tile) ? counts.layered : counts.summed;
        work.entries += counted.lengths[tile];
        for (std::uint32_t i = 0; i < counted.lengths[tile]; ++i, entry += entry_bytes)
          add_entry(entry, counts.patch, work);
      }
    }
  }

  // In the picture's own pixels, of an ordered frame.
  bool is_layered(std::uint32_t tile) const {
    const std::vector<shared::Grid>& grids = pipeline_.context().layout.grids;
    return plan_.needs_sort() && (grids.size() == 1 || tile < grids[1].first_tile);
  }

  void add_entry(const std::byte* entry, const PatchSize& patch, ListWork& work) const {
    if (plan_.is_extended()) return;
    float shape[4];  // x, y, sigma, radius (bin.h)
    std::memcpy(shape, entry, sizeof(shape));
    const Disc disc = {shape[0], shape[1], shape[3]};
    const double width = variant().tile_width, height = variant().tile_height;
    work.row_parts += row_parts_of(disc, width, height);
    if (patch.width > 0) work.patches += patches_of(disc, width, height, patch);
  }

  DeviceContext& device_;
  const FramePlan& plan_;
  ParticleStore store_;
  Pipeline pipeline_;
};

// As patch.cl has them for three planes, and waiting.cl leaves discs to them.
bool takes_patches(const Frame& frame, const FramePlan& plan, const Variant& variant,
                   const DeviceTraits& traits) {
  return traits.rows && frame.kernel.cut && frame.kernel.sampling == Sampling::center &&
         variant.planes() == 3 && !plan.needs_sort() && !plan.is_extended();
}
PatchSize patch_of(const DeviceTraits& traits) {
  if (traits.rows_of_16) return {16, 8};
  return {8, 4};
}

}  // namespace

double row_parts_of(const Disc& disc, double tile_width, double tile_height) {
  const auto x = static_cast<double>(disc.x), y = static_cast<double>(disc.y);
  const auto radius = static_cast<double>(disc.radius);
  if (radius < 0) return 0;
  double parts = 0;
  const double first = std::max(-tile_height / 2, std::ceil(y - radius - 0.5));
  const double end = std::min(tile_height / 2, std::floor(y + radius + 0.5));
  for (double row = first; row < end; ++row) {
    const double along = row + 0.5 - y;
    const double across = std::sqrt(std::max(0.0, radius * radius - along * along));
    parts += std::ceil(pixels_within(x, across, tile_width) / 8);
  }
  return parts;
}

double patches_of(const Disc& disc, double tile_width, double tile_height, const PatchSize& patch) {
  const auto x = static_cast<double>(disc.x), y = static_cast<double>(disc.y);
  const auto radius = static_cast<double>(disc.radius);
  if (radius < 0) return 0;
  const double columns = pixels_within(x, radius, tile_width);
  const double rows = pixels_within(y, radius, tile_height);
  if (columns <= widest_without_patches && rows <= widest_without_patches) return 0;
  const std::vector<double> across = nearest_squares(x, tile_width, patch.width);
  double patches = 0;
  for (const double along : nearest_squares(y, tile_height, patch.height)) {
    for (const double square : across)
      patches += square + along <= radius * radius;
  }
  return patches;
}

FrameCounts frame_counts(const Frame& frame, const RenderStats& stats,
                         const std::string& device_name) {
  DeviceContext device(choose_device(device_name));
  const FramePlan plan = make_plan(frame);
  const Variant variant(frame, plan, device.traits);
  FrameCounts counts;
  counts.is_ordered = plan.needs_sort();
  counts.is_collected = plan.has_errors_of_splats;
  counts.slabs = plan.slabs;
  counts.particles = static_cast<double>(stats.particles);
  counts.particle_bytes = static_cast<double>(particle_bytes(frame)) / counts.particles;
  counts.splats = static_cast<double>(stats.drawn_particles);
  counts.splat_bytes = static_cast<double>(variant.splat_bytes() + variant.extended_splat_bytes());
  counts.entry_bytes = static_cast<double>(variant.tile_splat_bytes());
  const bool by_depth = frame.sort.by == SortOrder::By::depth;
  counts.key_bytes = sizeof(std::uint32_t) + (by_depth ? sizeof(std::uint16_t) : 0);
  counts.pixels = static_cast<double>(frame.crop.width) * frame.crop.height;
  counts.planes = variant.planes();
  if (takes_patches(frame, plan, variant, device.traits)) counts.patch = patch_of(device.traits);
  ListReader(device, frame, plan).read(counts);
  return counts;
}

}  // namespace splotchcl::bench
