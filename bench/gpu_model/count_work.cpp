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

// Parts of a tile (kernels/composite/composite_groups.cl).
constexpr int tile_side = 16, part_width = 8, part_height = 4;

// As reaches() there.
int parts_of(const float* entry) {
  int parts = 0;
  for (int y = 0; y < tile_side; y += part_height) {
    for (int x = 0; x < tile_side; x += part_width) {
      const float across = entry[0] - static_cast<float>(x + part_width / 2 - tile_side / 2);
      const float along = entry[1] - static_cast<float>(y + part_height / 2 - tile_side / 2);
      parts += std::abs(across) <= 0.5f * (part_width - 1) + entry[3] &&
               std::abs(along) <= 0.5f * (part_height - 1) + entry[3];
    }
  }
  return parts;
}

// Runs the stages of a frame one by one, and reads back what lists there are.
class Counter {
 public:
  Counter(DeviceContext& device, const Frame& frame)
      : device_(device),
        store_(device),
        plan_(make_plan(frame)),
        pipeline_(device, store_, frame, plan_),
        certifier_(pipeline_.context()) {
    const Specialization& specialization = pipeline_.context().specialization;
    work_.is_ordered = plan_.needs_sort();
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
    for (const SplatChunk& chunk : splat_chunks(sorted.count, device_.traits)) {
      work_.chunk = std::max(work_.chunk, static_cast<double>(chunk.count));
      draw_lists(pipeline_.binner().count(sorted, chunk));
    }
  }

  void draw_sums() {
    for (const ParticleChunk& chunk : pipeline_.particle_chunks()) {
      SplatBlocks blocks = pipeline_.project(chunk);
      work_.chunk = std::max(work_.chunk, static_cast<double>(chunk.end - chunk.first));
      draw_lists(pipeline_.binner().count(blocks));
      work_.splats += static_cast<double>(pipeline_.projector().count(blocks).visible);
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
      count_entries(lists);
    }
  }

  void count_entries(const TileLists& lists) {
    const auto floats = static_cast<std::size_t>(work_.entry_bytes) / sizeof(float);
    const std::vector<std::byte> bytes =
        device_.pool.download(lists.entries, lists.entry_count * floats * sizeof(float));
    std::vector<float> values(lists.entry_count * floats);
    std::memcpy(values.data(), bytes.data(), bytes.size());
    for (std::size_t i = 0; i < values.size(); i += floats)
      work_.drawn_parts += parts_of(values.data() + i);
    work_.entries += static_cast<double>(lists.entry_count);
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

CountedWork count_frame(DeviceContext& device, const Frame& frame) {
  choose_shape(device.traits, false);
  CountedWork counted;
  device.launches = &counted.launches;
  counted.work = Counter(device, frame).draw();
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
