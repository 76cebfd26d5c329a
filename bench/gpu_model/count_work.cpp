#include "gpu_model/count_work.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <utility>

#include "device/pipeline.h"
#include "synthetic.h"

namespace splotchcl::bench {
namespace {

// Parts of a tile (kernels/composite/tile_batch.cl).
constexpr int tile_side = 16, part_width = 8, part_height = 4;

// As reaches_part() there, but that splats that are cut count as if they were not.
int parts_of(const float* entry, bool is_ellipse, float mean_sigma) {
  const bool is_mean = entry[2] < mean_sigma || (is_ellipse && entry[4] < mean_sigma);
  const float radius = entry[3], radius_x = is_ellipse ? entry[5] : radius;
  int parts = 0;
  for (int y = 0; y < tile_side; y += part_height) {
    for (int x = 0; x < tile_side; x += part_width) {
      const float across =
          std::abs(entry[0] - static_cast<float>(x + part_width / 2 - tile_side / 2)) -
          0.5f * (part_width - 1);
      const float along =
          std::abs(entry[1] - static_cast<float>(y + part_height / 2 - tile_side / 2)) -
          0.5f * (part_height - 1);
      if (across > radius_x || along > radius) continue;
      const float dx = std::max(across, 0.0f) * radius / radius_x, dy = std::max(along, 0.0f);
      parts += is_mean || dx * dx + dy * dy <= radius * radius;
    }
  }
  return parts;
}

// Runs the stages of a frame one by one, and reads back what lists there are.
class Counter {
 public:
  Counter(DeviceContext& device, const Frame& frame, const PlanOptions& options)
      : device_(device),
        store_(device),
        plan_(make_plan(frame, options)),
        pipeline_(device, store_, frame, plan_),
        certifier_(pipeline_.context()) {
    const Specialization& specialization = pipeline_.context().specialization;
    work_.is_ordered = plan_.needs_sort();
    work_.is_extended = plan_.is_extended();
    work_.extended_splat_bytes = static_cast<double>(specialization.extended_splat_bytes());
    work_.pixels = static_cast<double>(frame.crop.width) * frame.crop.height;
    work_.planes = specialization.planes();
    work_.splat_bytes = static_cast<double>(specialization.splat_bytes());
    work_.entry_bytes = static_cast<double>(specialization.tile_splat_bytes());
    work_.splats_per_particle = static_cast<double>(plan_.splats_per_particle);
    work_.segment_length = device.traits.segment_length;
    work_.tiles = pipeline_.context().layout.tile_count;
    std::uint64_t values = 0;
    for (const DrawnComponent& component : frame.components) {
      const Particles& p = component.particles;
      for (const Column* column : {&p.position, &p.smoothing_length, &p.weight, &p.color,
                                   &p.color_vector, &p.intensity, &p.sort_field}) {
        values += column->size();
      }
    }
    work_.particles = static_cast<double>(particle_count(frame));
    work_.particle_bytes = 4.0 * static_cast<double>(values) / work_.particles;
  }

  FrameWork draw() {
    planes_ = pipeline_.compositor().start();
    if (plan_.needs_sort()) {
      draw_ordered();
    } else {
      draw_sums();
    }
    pipeline_.resolver().resolve(std::move(planes_));
    device_.queue.finish();
    return work_;
  }

 private:
  void draw_ordered() {
    KeyedSplats keyed = pipeline_.project_all();
    work_.splats = keyed.count;
    const SortedSplats sorted = pipeline_.sorter().sort(std::move(keyed));
    SlabLight slab_light;
    if (plan_.slabs > 0) slab_light = pipeline_.resolver().start_slabs();
    for (const SplatChunk& chunk : splat_chunks(sorted.count, plan_.slabs, device_.traits)) {
      work_.chunk = std::max(work_.chunk, static_cast<double>(chunk.count));
      draw_lists(pipeline_.binner().count(sorted, chunk));
      if (chunk.ends_slab) planes_ = pipeline_.resolver().lay_slab(std::move(planes_), slab_light);
    }
  }

  void draw_sums() {
    for (const ParticleChunk& chunk : pipeline_.particle_chunks()) {
      SplatBlocks blocks = pipeline_.project(chunk);
      work_.chunk = std::max(work_.chunk, static_cast<double>(chunk.end - chunk.first));
      draw_lists(pipeline_.binner().count(blocks));
      work_.splats += static_cast<double>(pipeline_.projector().count(blocks, chunk).visible);
    }
  }

  void draw_lists(const CountedSplats& counted) {
    for (const std::uint32_t length : counted.lengths)
      work_.longest_list = std::max(work_.longest_list, static_cast<double>(length));
    for (const TileBand& band : counted.bands) {
      const TileLists lists = pipeline_.binner().make_lists(counted, band);
      if (lists.entry_count == 0) continue;
      certifier_.collect(lists);
      planes_ = pipeline_.compositor().composite(lists, *counted.splats, std::move(planes_));
      count_entries(lists, counted, band);
    }
  }

  void count_entries(const TileLists& lists, const CountedSplats& counted, const TileBand& band) {
    work_.entries += static_cast<double>(lists.entry_count);
    work_.partial_tiles += lists.partial_count;
    // Groups of extended numbers draw all of a tile.
    if (plan_.is_extended()) {
      work_.full_parts += 8 * static_cast<double>(lists.entry_count);
      return;
    }
    const auto floats = static_cast<std::size_t>(work_.entry_bytes) / sizeof(float);
    const std::vector<std::byte> bytes =
        device_.pool.download(lists.entries, lists.entry_count * floats * sizeof(float));
    std::vector<float> values(lists.entry_count * floats);
    std::memcpy(values.data(), bytes.data(), bytes.size());
    const float* entry = values.data();
    for (std::uint32_t tile = band.first; tile < band.end; ++tile) {
      const std::size_t grid = grid_of(tile);
      for (std::uint32_t i = 0; i < counted.lengths[tile]; ++i, entry += floats)
        count_entry(entry, floats, grid);
    }
  }

  std::size_t grid_of(std::uint32_t tile) const {
    const std::vector<shared::Grid>& grids = pipeline_.context().layout.grids;
    std::size_t g = 0;
    while (g + 1 < grids.size() && tile >= grids[g + 1].first_tile)
      ++g;
    return g;
  }

  // As tile_batch.cl decides.
  void count_entry(const float* entry, std::size_t floats, std::size_t grid) {
    const float mean_sigma = pipeline_.context().layout.grids[grid].mean_sigma;
    const float sigma = entry[2];
    work_.bright_entries += sigma < 0;
    work_.mean_entries += sigma >= 0 && sigma < mean_sigma;
    const int parts = parts_of(entry, plan_.has_ellipses, mean_sigma);
    if (!work_.is_ordered || grid > 0) {
      (work_.is_ordered ? work_.slab_parts : work_.thin_parts) += parts;
      return;
    }
    const float* absorption = entry + floats - 6;
    const float flux = 3.15f * std::abs(sigma * (plan_.has_ellipses ? entry[4] : sigma));
    const float deepest = std::max({absorption[0], absorption[1], absorption[2]}) *
                          (sigma < mean_sigma ? std::min(1.0f, flux) : 1.0f);
    if (deepest <= plan_.layers.phi_short && !plan_.layers.keeps_transmittance) {
      work_.thin_parts += parts;
    } else if (deepest <= plan_.layers.phi_series) {
      work_.series_parts += parts;
    } else {
      work_.full_parts += parts;
    }
  }

  DeviceContext& device_;
  ParticleStore store_;
  const FramePlan plan_;
  Pipeline pipeline_;
  Certifier certifier_;
  Planes planes_;
  FrameWork work_;
};

}  // namespace

CountedWork count_frame(DeviceContext& device, const Frame& frame, const PlanOptions& options) {
  choose_shape(device.traits, false);
  CountedWork counted;
  device.launches = &counted.launches;
  counted.work = Counter(device, frame, options).draw();
  device.launches = nullptr;
  device.timer.clear();
  return counted;
}

CountedWork count_sort(DeviceContext& device, std::uint32_t pairs) {
  choose_shape(device.traits, false);
  Random random(5);
  std::vector<std::uint32_t> keys(pairs), values(pairs);
  std::generate(keys.begin(), keys.end(), [&random] { return random.bits(); });
  std::iota(values.begin(), values.end(), 0u);
  CountedWork counted;
  device.launches = &counted.launches;
  Sorter(device).sort(device.pool.upload(keys, "keys"), device.pool.upload(values, "values"),
                      pairs);
  device.queue.finish();
  device.launches = nullptr;
  device.timer.clear();
  return counted;
}

}  // namespace splotchcl::bench
