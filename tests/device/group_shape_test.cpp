// The shape for GPUs: how it uses the device, and its own pieces.
#include "device/cases.h"
#include "device/opencl/device_context.h"
#include "device/pictures.h"
#include "device/stages.h"
#include "device/stages/binner.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

class GroupShape : public StageTest {
 protected:
  // Clouds from far below a pixel to wider than many tiles.
  static Frame clouds(LightPlan plan, double tolerance, int count = 3000) {
    Frame frame = clouds_for(plan, {count, 230, 170});
    frame.tolerance = tolerance;
    return frame;
  }

  static std::vector<LaunchRecord> launches(const Frame& frame) {
    std::vector<LaunchRecord> launches;
    device().launches = &launches;
    draw_once(device(), frame, CompositeShape::groups);
    device().launches = nullptr;
    return launches;
  }

  static std::ptrdiff_t count_of(const std::string& kernel,
                                 const std::vector<LaunchRecord>& launches) {
    return std::count_if(launches.begin(), launches.end(),
                         [&](const LaunchRecord& launch) { return launch.kernel == kernel; });
  }
};

TEST_F(GroupShape, LaunchesWorkGroupsOfManyItemsOnly) {
  for (const LightPlan plan : {LightPlan::emission, LightPlan::proportional, LightPlan::ordered}) {
    for (const double tolerance : {1e-3, 0.0}) {
      const std::vector<LaunchRecord> found =
          launches(clouds(plan, tolerance, tolerance > 0 ? 3000 : 20));
      ASSERT_GT(found.size(), 10u);
      for (const LaunchRecord& launch : found) {
        EXPECT_GE(launch.group_items, 32u) << launch.kernel;
        // The least that OpenCL 1.2 promises.
        EXPECT_LE(launch.local_bytes, 32768u) << launch.kernel;
      }
    }
  }
}

// Rows of tiles are cut where bands of tiles end: each part has its own entries, and all of them
// together are the whole.
TEST_F(GroupShape, DrawsTheSamePictureInBandsOfTilesBitForBit) {
  for (const LightPlan plan : {LightPlan::emission, LightPlan::ordered}) {
    const Frame frame = clouds(plan, 1e-3);
    const FramePlan frame_plan = make_plan(frame);
    ParticleStore particles(device());
    device().traits.choose_shape(false);
    const DeviceTraits traits = device().traits;
    // One tile may have all splats of a chunk, so that a band holds as many at least.
    device().traits.chunk_blocks = 2;
    device().traits.sorted_chunk = 512;
    std::vector<LaunchRecord> at_once, in_bands;
    device().launches = &at_once;
    const Image whole = Pipeline(device(), particles, frame, frame_plan).draw();
    device().launches = &in_bands;
    device().traits.list_capacity = 1;
    const Image banded = Pipeline(device(), particles, frame, frame_plan).draw();
    device().launches = nullptr;
    device().traits = traits;
    EXPECT_GT(count_of("bin_make_entries", in_bands), count_of("bin_make_entries", at_once))
        << "the lists must not fit";
    EXPECT_EQ(whole.pixels, banded.pixels);
  }
}

// Particles of a chunk where the GPU has so many bytes.
std::uint32_t chunk_length_of_gpu(std::uint64_t memory) {
  DeviceTraits traits;
  traits.gpu_memory = memory;
  traits.choose_shape(false);
  return traits.chunk_length();
}

TEST(ChunksOfGpus, FollowFromTheirMemoryAlone) {
  EXPECT_EQ(chunk_length_of_gpu(0), 1u << 20) << "of a processor";
  EXPECT_EQ(chunk_length_of_gpu(4000000000), 1u << 20);
  EXPECT_EQ(chunk_length_of_gpu(8000000000), 1u << 22);
  EXPECT_EQ(chunk_length_of_gpu(80000000000), 1u << 24);
}

// Boxes are made around blocks, and left out by the number of a group.
TEST_F(GroupShape, RefusesBlocksOfOtherSizesThanItsGroups) {
  device().traits.choose_shape(false);
  const DeviceTraits traits = device().traits;
  device().traits.project_block = GROUP_ITEMS / 2;
  EXPECT_THROW(draw_once(device(), clouds(LightPlan::emission, 1e-3), CompositeShape::groups),
               DeviceError);
  device().traits = traits;
}

TEST_F(GroupShape, DrawsTheSameBitsAgain) {
  for (const LightPlan plan : {LightPlan::proportional, LightPlan::ordered}) {
    const Frame frame = clouds(plan, 1e-3);
    EXPECT_EQ(draw_once(device(), frame, CompositeShape::groups).pixels,
              draw_once(device(), frame, CompositeShape::groups).pixels);
  }
}

// GPUs take their own 2^t where it serves, which this device's does.
TEST_F(GroupShape, HoldsItsToleranceWithTheDevicesOwnPowersOfTwo) {
  ASSERT_TRUE(native_exp2_serves(device())) << error_of_native_exp2(device());
  device().traits.choose_shape(false);
  const DeviceTraits traits = device().traits;
  device().traits.native_exp2 = true;
  for (const LightPlan plan : {LightPlan::emission, LightPlan::ordered}) {
    for (const bool is_cut : {false, true}) {
      Frame frame = clouds(plan, 1e-3, 300);
      if (is_cut) {
        frame.kernel.cut = 2;
        frame.kernel.sampling = Sampling::center;
      }
      EXPECT_LE(largest_error(draw_once(device(), frame, CompositeShape::groups),
                              reference::render(frame)),
                frame.tolerance)
          << name(plan) << (is_cut ? ", cut" : "");
    }
  }
  device().traits = traits;
}

// Layers of a tile whose list is cut differ by roundings from those of a whole one.
TEST_F(GroupShape, JoinsSegmentsToTheSamePicture) {
  const Frame frame = clouds(LightPlan::ordered, 1e-3);
  device().traits.choose_shape(false);
  const DeviceTraits traits = device().traits;
  const Image whole = draw_once(device(), frame, CompositeShape::groups);
  device().traits.segment_length = 33;
  const Image joined = draw_once(device(), frame, CompositeShape::groups);
  device().traits = traits;
  EXPECT_NE(whole.pixels, joined.pixels) << "lists must be cut";
  EXPECT_LE(largest_difference(whole, joined), 1e-5);
}

// What the check after drawing is told by both shapes is the same but for roundings and tiles.
TEST_F(GroupShape, CollectsWhatRowsCollect) {
  for (const LightPlan plan : {LightPlan::emission, LightPlan::ordered}) {
    const Frame frame = clouds(plan, 1e-3);
    const FramePlan frame_plan = make_plan(frame);
    std::vector<double> sums;
    for (const std::uint32_t segment : {0u, 40u}) {
      for (const bool rows : {true, false}) {
        ParticleStore particles(device());
        device().traits.choose_shape(rows);
        const DeviceTraits traits = device().traits;
        if (segment > 0) device().traits.segment_length = segment;
        Pipeline pipeline(device(), particles, frame, frame_plan);
        pipeline.draw();
        double peaks = 0, endings = 0;
        for (const PeakCells& cells : pipeline.collected().cells) {
          for (const float value : cells.peaks.values)
            peaks += static_cast<double>(value);
          for (const float value : cells.endings.values)
            endings += static_cast<double>(value);
        }
        sums.push_back(peaks);
        sums.push_back(endings);
        device().traits = traits;
      }
    }
    for (std::size_t i = 2; i < sums.size(); ++i)
      EXPECT_NEAR(sums[i], sums[i % 2], 1e-5 * sums[i % 2]) << i;
  }
}

// Splats of few tiles count in each, those of many at the corners of their tiles.
TEST(LengthsOfLists, AddUpTilesAndCorners) {
  PictureLayout layout;
  shared::Grid grid{};
  grid.tiles_x = 4;
  grid.tiles_y = 3;
  layout.grids = {grid};
  layout.tile_count = 12;
  std::vector<std::uint32_t> counts(24, 0);
  counts[5] = 2;
  // One over columns 1 and 2 of the first two rows, one over everything.
  counts[12 + 1] += 1;
  counts[12 + 3] -= 1;
  counts[12 + 9] -= 1;
  counts[12 + 11] += 1;
  counts[12 + 0] += 1;
  EXPECT_EQ(lengths_of_lists(counts, layout),
            (std::vector<std::uint32_t>{1, 2, 2, 1, 1, 4, 2, 1, 1, 1, 1, 1}));
}

TEST(LengthsOfLists, AreOfEachGridAlone) {
  PictureLayout layout;
  shared::Grid fine{}, coarse{};
  fine.tiles_x = coarse.tiles_x = 2;
  fine.tiles_y = coarse.tiles_y = 1;
  coarse.first_tile = 2;
  layout.grids = {fine, coarse};
  layout.tile_count = 4;
  std::vector<std::uint32_t> counts(8, 0);
  counts[4 + 0] = 3;
  EXPECT_EQ(lengths_of_lists(counts, layout), (std::vector<std::uint32_t>{3, 3, 0, 0}));
}

TEST(Segments, CutListsOfABandOnly) {
  const auto segments = cut_in_segments({9, 0, 3, 7, 5}, {1, 4}, 3);
  ASSERT_EQ(segments.size(), 4u);
  EXPECT_EQ(segments[0].tile, 2u);
  EXPECT_EQ(segments[0].begin, 0u);
  EXPECT_EQ(segments[0].partial, NO_PARTIAL);
  EXPECT_EQ(segments[3].tile, 3u);
  EXPECT_EQ(segments[3].begin, 9u);
  EXPECT_EQ(segments[3].end, 10u);
  EXPECT_EQ(segments[3].partial, 2u);
}

}  // namespace
}  // namespace splotchcl::test
