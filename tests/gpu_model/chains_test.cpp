// The longest chains of steps in each launch of the shape for GPUs, as the model has them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "gpu_model/count_work.h"
#include "splotchcl/camera.h"
#include "synthetic.h"

namespace splotchcl::bench {
namespace {

struct ScaledFrame {
  std::string name;
  std::function<Frame(int scale)> make;  // particles and pixels grow with the scale
  int slabs = 0;                         // PlanOptions
};

Frame universe(LightPlan light, int scale, std::size_t particles = 2000) {
  UniverseSetup setup;
  setup.particles = particles * static_cast<std::size_t>(scale);
  const int side = static_cast<int>(std::lround(std::sqrt(scale)));
  Frame frame = universe_frame(make_universe(setup), 80 * side, 60 * side);
  set_light(frame, light);
  return frame;
}

// All in one tile, and all but one as far away.
Frame crowd(int scale, std::size_t particles, double tolerance) {
  CloudSetup setup;
  setup.width = setup.height = 4;
  setup.count = particles * static_cast<std::size_t>(scale);
  setup.depth_low = setup.depth_high = 1;
  DrawnComponent behind = make_clouds(setup);
  setup.count = 1;
  setup.depth_low = setup.depth_high = 1e9;
  Frame frame = cloud_frame(16, 16, {std::move(behind), make_clouds(setup)});
  set_light(frame, LightPlan::ordered);
  frame.tolerance = tolerance;
  return frame;
}

Frame all_around(int scale) {
  Frame frame = universe(LightPlan::ordered, scale, 300);
  frame.height = frame.width / 2;
  frame.crop = {0, 0, frame.width, frame.height};
  Camera camera;
  camera.position = {{0.5, 0.5, 0.5}};
  camera.look_at = {{0.5, 1, 0.5}};
  camera.sky = {{0, 0, 1}};
  camera.projection = frame.projection = Projection::equirectangular;
  frame.camera = make_camera_frame(camera, frame.width, frame.height);
  return frame;
}

std::vector<ScaledFrame> frames() {
  return {{"emission", [](int scale) { return universe(LightPlan::emission, scale); }},
          {"proportional", [](int scale) { return universe(LightPlan::proportional, scale); }},
          {"ordered", [](int scale) { return universe(LightPlan::ordered, scale); }},
          {"slabs", [](int scale) { return universe(LightPlan::ordered, scale); }, 3},
          {"crowd", [](int scale) { return crowd(scale, 600, 1e-3); }},
          {"exact crowd", [](int scale) { return crowd(scale, 40, 0); }},
          {"all around", [](int scale) { return all_around(scale); }}};
}

// Lists are cut at so many entries, far fewer than a GPU's, so that those of small frames are.
constexpr std::uint32_t segment_length = 100;

CountedWork count(const ScaledFrame& frame, int scale) {
  DeviceContext device(choose_device(""));
  choose_shape(device.traits, false);
  device.traits.segment_length = segment_length;
  PlanOptions options;
  options.slabs = frame.slabs;
  return count_frame(device, frame.make(scale), options);
}

using Chains = std::map<std::string, double>;

Chains chains(const CountedWork& counted) {
  Chains chains;
  for (const LaunchRecord& launch : counted.launches) {
    const double chain =
        cost_of(launch.kernel, static_cast<double>(launch.items), 1, counted.work).chain;
    chains[launch.kernel] = std::max(chains[launch.kernel], chain);
  }
  return chains;
}

// Sixteen times the particles and the pixels.
constexpr int larger = 16;

TEST(Chains, AreLogarithmicInTheFrameOrBoundedByTheChunk) {
  std::set<std::string> seen;
  for (const ScaledFrame& frame : frames()) {
    const CountedWork small = count(frame, 1), large = count(frame, larger);
    const Chains of_small = chains(small);
    for (const auto& [kernel, chain] : chains(large)) {
      seen.insert(kernel);
      EXPECT_LE(chain, longest_chain(kernel, large.work)) << frame.name << ": " << kernel;
      // But for lists no step is added except those of searches.
      const double of_lists =
          longest_chain(kernel, large.work) - longest_chain("project", large.work);
      if (of_lists > 0 || of_small.count(kernel) == 0) continue;
      EXPECT_LE(chain, of_small.at(kernel) + 2 * std::log2(larger) + 1)
          << frame.name << ": " << kernel;
    }
    EXPECT_GT(large.work.longest_list, 3 * segment_length) << frame.name << ": lists must be cut";
  }
  // Of none of the kernels is it only said.
  EXPECT_EQ(seen, known_kernels());
}

// One work-item that goes through all particles, entries, tiles or pixels would be found.
TEST(Chains, AreShorterThanAnyWalkOverTheFrame) {
  const FrameWork work = count(frames()[2], larger).work;
  for (const char* const kernel : {"project", "scan_reduce", "bin_emit", "composite", "join"}) {
    for (const double walk : {work.particles, work.entries, work.pixels})
      EXPECT_GT(walk, longest_chain(kernel, work)) << kernel;
  }
}

}  // namespace
}  // namespace splotchcl::bench
