// What the model of a GPU says of the kernels of its shape.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "gpu_model/count_work.h"
#include "gpu_model/prediction.h"
#include "splotchcl/error.h"
#include "synthetic.h"

namespace splotchcl::bench {
namespace {

CountedWork universe(std::size_t particles, int width, int height, LightPlan light) {
  DeviceContext device(choose_device(""));
  UniverseSetup setup;
  setup.particles = particles;
  Frame frame = universe_frame(make_universe(setup), width, height);
  set_light(frame, light);
  return count_frame(device, frame);
}

class GpuModel : public testing::TestWithParam<LightPlan> {};

// A particle is read twice and written once, an entry is written once and read by two stages: no
// model of these kernels can say less.
TEST_P(GpuModel, CountsTheBytesThatAFrameMoves) {
  const CountedWork counted = universe(20000, 200, 150, GetParam());
  std::map<std::string, KernelCost> costs;
  for (const KernelWork& kernel : add_up(counted.launches, counted.work))
    costs[kernel.stage + kernel.kernel] = kernel.cost;
  const FrameWork& work = counted.work;
  EXPECT_GE(costs["projectproject"].bytes_read, 2 * work.particles * work.particle_bytes);
  EXPECT_GE(costs["projectproject"].bytes_written, work.splats * work.splat_bytes);
  EXPECT_GE(costs["binbin_make_entries"].bytes_written, work.entries * work.entry_bytes);
  EXPECT_GE(costs["compositecomposite"].bytes_read, work.entries * work.entry_bytes);
  EXPECT_GE(work.drawn_parts(), 0.5 * work.entries);
  EXPECT_LE(work.drawn_parts(), 8 * work.entries);
}

INSTANTIATE_TEST_SUITE_P(Plans, GpuModel,
                         testing::Values(LightPlan::proportional, LightPlan::ordered),
                         [](const auto& info) { return std::string(name(info.param)); });

TEST(GpuModelOfSorts, MovesAHundredBytesForEachPairAtMost) {
  DeviceContext device(choose_device(""));
  const CountedWork counted = count_sort(device, 100000);
  double bytes = 0;
  for (const KernelWork& kernel : add_up(counted.launches, counted.work))
    bytes += kernel.cost.bytes_read + kernel.cost.bytes_written;
  EXPECT_LE(bytes / 100000, 100);
  EXPECT_GE(bytes / 100000, 4 * 20);
}

TEST(GpuModelOfKernels, KnowsNoneThatItWasNotTold) {
  EXPECT_THROW(cost_of("walk_everything", 1, 1, {}), UsageError);
}

TEST(Roofline, IsTheLongestOfMemoryOperationsAndLaunches) {
  KernelWork work;
  work.launches = 1;
  work.cost.bytes_read = 3350e6;
  EXPECT_NEAR(roofline(work, {"H100", 3350, 66.9, 132}).total(), 1e-3, 1e-9);
  EXPECT_STREQ(roofline(work, {"H100", 3350, 66.9, 132}).bound_by(), "memory");
  work.cost.operations = 66.9e9;
  EXPECT_NEAR(roofline(work, {"H100", 3350, 66.9, 132}).total(), 2e-3, 1e-9);
}

}  // namespace
}  // namespace splotchcl::bench
