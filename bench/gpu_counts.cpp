// Counts what the plan of an ordered frame gives a GPU to do, for bench/gpu_model: lists are made
// as for a GPU, on any device, and looked at as kernels/composite/tile_batch.cl would draw them.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "arguments.h"
#include "device/opencl/device_context.h"
#include "device/pipeline.h"
#include "splotchcl/error.h"
#include "splotchcl/load.h"
#include "splotchcl/plan.h"
#include "splotchcl/renderer.h"
#include "splotchcl/scene_file.h"
#include "splotchcl/snapshot_file.h"

namespace splotchcl::bench {
namespace {

// As tile_batch.cl has them: pixels of a part, splats of a batch.
constexpr std::uint32_t part_side = 8, splats_of_batch = 32;

// An entry of an ordered list (bin.h).
struct Entry {
  float x, y, sigma, radius, absorption[3], emission[3];
};

struct Counts {
  double particles = 0, splats = 0, chunks = 0, tiles = 0, entries = 0, segments = 0;
  double means = 0;  // entries that take means over pixels
  double batches = 0;
  // Of parts of tiles in which entries of a batch are drawn: by as many terms of phi's series as
  // all that the batch has for the part get by with.
  std::array<double, 3> drawn = {};
};

class Counter {
 public:
  Counter(DeviceContext& device, const Frame& frame, const FramePlan& plan)
      : device_(device), plan_(plan), store_(device), pipeline_(device, store_, frame, plan) {
    if (variant().tile_splat_bytes() != sizeof(Entry))
      throw UsageError("the scene's lists have other entries than plain ordered ones");
  }

  Counts count() {
    const SortedSplats sorted = pipeline_.sorter().sort(pipeline_.project_all());
    counts_.splats = static_cast<double>(sorted.count);
    counts_.tiles = pipeline_.context().layout.tile_count;
    for (const SplatChunk& chunk :
         splat_chunks(sorted.count, pipeline_.context().plan.slabs, device_.traits)) {
      const CountedSplats counted = pipeline_.binner().count(sorted, chunk);
      for (const TileBand& band : counted.bands)
        add_lists(pipeline_.binner().make_lists(counted, band));
      ++counts_.chunks;
    }
    return counts_;
  }

 private:
  const Variant& variant() const { return pipeline_.context().variant; }

  void add_lists(const TileLists& lists) {
    const std::vector<std::byte> bytes =
        device_.pool.download(lists.entries, lists.entry_count * sizeof(Entry));
    std::vector<Entry> entries(lists.entry_count);
    std::memcpy(entries.data(), bytes.data(), entries.size() * sizeof(Entry));
    for (const shared::Segment& segment :
         device_.pool.download(lists.segments, lists.segment_count)) {
      ++counts_.segments;
      for (std::uint32_t first = segment.begin; first < segment.end; first += splats_of_batch)
        add_batch(entries.data() + first, std::min(splats_of_batch, segment.end - first));
    }
    counts_.entries += static_cast<double>(entries.size());
  }

  void add_batch(const Entry* batch, std::uint32_t count) {
    ++counts_.batches;
    const float width = static_cast<float>(variant().tile_width) / 2;
    const float height = static_cast<float>(variant().tile_height) / 2;
    counts_.means += static_cast<double>(std::count_if(
        batch, batch + count, [&](const Entry& e) { return e.sigma < plan_.splats.mean_sigma; }));
    for (float y = 0.5f * part_side - height; y < height; y += part_side) {
      for (float x = 0.5f * part_side - width; x < width; x += part_side)
        add_part(batch, count, x, y);
    }
  }

  void add_part(const Entry* batch, std::uint32_t count, float x, float y) {
    std::size_t drawn = 0, terms = 0;
    for (std::uint32_t k = 0; k < count; ++k) {
      if (!reaches(batch[k], x, y)) continue;
      ++drawn;
      terms = std::max(terms, terms_of(batch[k]));
    }
    counts_.drawn[terms] += static_cast<double>(drawn);
  }

  // reaches_part() of tile_batch.cl.
  bool reaches(const Entry& entry, float x, float y) const {
    const float across = std::abs(entry.x - x) - 0.5f * (part_side - 1);
    const float along = std::abs(entry.y - y) - 0.5f * (part_side - 1);
    if (across > entry.radius || along > entry.radius) return false;
    if (variant().kernel_cut || entry.sigma < plan_.splats.mean_sigma) return true;
    const float dx = std::max(across, 0.0f), dy = std::max(along, 0.0f);
    return dx * dx + dy * dy <= entry.radius * entry.radius;
  }

  // One, two or more terms, from 0 on: deepest_of() of tile_batch.cl.
  std::size_t terms_of(const Entry& entry) const {
    const float flux = 3.15f * entry.sigma * entry.sigma;
    const float deepest = *std::max_element(entry.absorption, entry.absorption + 3) *
                          (entry.sigma < plan_.splats.mean_sigma ? std::min(1.0f, flux) : 1.0f);
    const LayerLimits& limits = plan_.layers;
    return std::size_t{deepest > limits.phi_first} + std::size_t{deepest > limits.phi_short};
  }

  DeviceContext& device_;
  const FramePlan& plan_;
  ParticleStore store_;
  Pipeline pipeline_;
  Counts counts_;
};

void print_counts(const Arguments& arguments) {
  const std::string file = arguments.text("scene", ""),
                    snapshot_file = arguments.text("snapshot", "");
  if (file.empty() || snapshot_file.empty())
    throw UsageError("--scene or --snapshot is missing:\n" + arguments.help());
  const Scene scene = read_scene_file(file, {"snapshot=\"" + snapshot_file + '"'});
  const std::unique_ptr<Snapshot> snapshot = open_snapshot(scene.snapshot);
  std::vector<std::string> notes;
  const Frame frame = load_frame(scene, *snapshot, notes);
  DeviceContext device(choose_device(arguments.text("device", "")));
  device.traits.gpu_memory = std::uint64_t{80} << 30;
  device.traits.choose_shape(false);
  PlanOptions in_order;  // as GPUs draw
  in_order.slabs = 0;
  const FramePlan plan = Renderer::first_plan(frame, in_order, true);
  if (!plan.needs_sort()) throw UsageError(file + ": found a sum, expected an ordered scene");
  Counts counts = Counter(device, frame, plan).count();
  counts.particles = static_cast<double>(particle_count(frame));
  const double is_checked = plan.has_errors_of_splats ? 1 : 0;
  const std::pair<const char*, double> rows[] = {
      {"particles", counts.particles},
      {"splats", counts.splats},
      {"chunks", counts.chunks},
      {"pixels", static_cast<double>(frame.crop.width) * frame.crop.height},
      {"tiles", counts.tiles},
      {"entries", counts.entries},
      {"means", counts.means},
      {"segments", counts.segments},
      {"batches", counts.batches},
      {"drawn by one term", counts.drawn[0]},
      {"drawn by two terms", counts.drawn[1]},
      {"drawn by more terms", counts.drawn[2]},
      {"is checked", is_checked}};
  for (const auto& [name, count] : rows)
    std::printf("%s,%.0f\n", name, count);
}

}  // namespace
}  // namespace splotchcl::bench

int main(int count, char** words) {
  using namespace splotchcl::bench;
  return run_main(count, words,
                  {"scene=FILE: an ordered scene", "snapshot=FILE: its particles",
                   "device=NAME: part of a device's name", "help: shows this"},
                  print_counts);
}
