// Ordered frames that have no room in one piece, and columns that have none in one buffer: the
// same bits as in one piece.
#include "device/cloud_frames.h"
#include "device/counted_column.h"
#include "device/frame/picture_layout.h"
#include "device/pictures.h"
#include "device/stages.h"
#include "frames/random_frames.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

Column streamed(const Column& column) {
  return column.is_array() ? Column::made_by(std::make_shared<CountedColumn>(column)) : column;
}

Frame streamed(Frame frame) {
  for (DrawnComponent& component : frame.components) {
    Particles& particles = component.particles;
    for (Column* const column :
         {&particles.position, &particles.smoothing_length, &particles.weight, &particles.color,
          &particles.color_vector, &particles.intensity, &particles.sort_field}) {
      *column = streamed(*column);
    }
  }
  return frame;
}

class Windows : public StageTest, public testing::WithParamInterface<bool> {
 protected:
  // Few splats of a chunk and few particles of a block, so that small scenes have many.
  void SetUp() override {
    device().traits.choose_shape(GetParam());
    whole_ = device().traits;
    memory_ = device().memory;
    device().traits.project_block = GetParam() ? 16 : GROUP_ITEMS;
    device().traits.chunk_blocks = GetParam() ? 4 : 1;
    device().traits.sorted_chunk = 32;
  }
  void TearDown() override {
    device().traits = whole_;
    device().memory = memory_;
  }

  // Of a plan with so many slabs; below 0: as many as seem to pay.
  Image draw(const Frame& frame, int slabs = -1) {
    PlanOptions options;
    options.slabs = slabs;
    DrawnOnce drawn = draw_with_plan(device(), frame, make_plan(frame, options));
    counts_ = drawn.counts;
    return std::move(drawn.image);
  }
  Image draw_in_windows(const Frame& frame, std::uint64_t windows, int slabs = -1) {
    make_room_for(std::max<std::uint64_t>(1, (counts_.visible + windows - 1) / windows), frame);
    Image image = draw(frame, slabs);
    device().memory = memory_;
    return image;
  }
  const DrawCounts& counts() const { return counts_; }

 private:
  // The least memory that has room for so many splats.
  void make_room_for(std::uint64_t splats, const Frame& frame) {
    const FramePlan plan = make_plan(frame);
    const StageContext context(device(), frame, plan);
    std::uint64_t low = 0, high = std::uint64_t{1} << 40;
    while (high - low > 1) {
      device().memory.total = (low + high) / 2;
      (splat_capacity(context) >= splats ? high : low) = device().memory.total;
    }
    device().memory.total = high;
  }

  DeviceTraits whole_;
  DeviceMemory memory_;
  DrawCounts counts_;
};

INSTANTIATE_TEST_SUITE_P(Shapes, Windows, testing::Bool(),
                         [](const auto& info) { return info.param ? "rows" : "groups"; });

TEST_P(Windows, DrawTheBitsOfOnePieceForAllScenes) {
  int ordered = 0;
  std::uint64_t most_windows = 0;
  for (const std::uint64_t seed : seeds(1, 60)) {
    const Frame frame = SceneMaker(seed).make();
    if (choose_light(frame) != LightPlan::ordered) continue;
    const Image whole = draw(frame);
    if (counts().visible < 64 || counts().too_sharp > 0) continue;
    EXPECT_EQ(counts().windows, 0u);
    ++ordered;
    const DrawCounts of_whole = counts();
    for (const std::uint64_t windows : {2u, 7u, 50u}) {
      EXPECT_EQ(draw_in_windows(frame, windows).pixels, whole.pixels)
          << "seed " << seed << ", " << windows << " windows";
      most_windows = std::max(most_windows, counts().windows);
      EXPECT_EQ(counts().visible, of_whole.visible);
      EXPECT_EQ(counts().bad, of_whole.bad);
      EXPECT_EQ(counts().tile_entries, of_whole.tile_entries);
    }
  }
  EXPECT_GT(ordered, 2);
  EXPECT_GT(most_windows, 4u);
}

TEST_P(Windows, AreAsManyAsMemoryAsksFor) {
  const Frame frame = many_clouds(2000);
  const Image whole = draw(frame);
  for (const std::uint64_t windows : {2u, 7u, 50u}) {
    const std::uint64_t visible = counts().visible;
    EXPECT_EQ(draw_in_windows(frame, windows).pixels, whole.pixels);
    EXPECT_GE(counts().windows, windows);
    EXPECT_LE(counts().windows, 2 * windows + visible / 200);
  }
}

TEST_P(Windows, DrawTheBitsOfOnePieceWhateverIsDivided) {
  for (const DividedFrame& divided : divided_frames()) {
    SCOPED_TRACE(divided.name);
    const Image whole = draw(divided.frame, divided.slabs);
    EXPECT_EQ(counts().visible > 100, divided.least > 0);
    EXPECT_EQ(draw_in_windows(divided.frame, divided.windows, divided.slabs).pixels, whole.pixels);
    EXPECT_GE(counts().windows, divided.least);
  }
}

// Those lie between splats, wherever windows end.
TEST_P(Windows, HoldCloudsAroundTheCamera) {
  Frame frame = within_clouds();
  frame.tolerance = 1e-2;
  for (const int slabs : {0, 3}) {
    for (const bool descending : {false, true}) {
      frame.sort.descending = descending;
      const Image whole = draw(frame, slabs);
      EXPECT_GT(counts().around, 20u);
      EXPECT_GT(counts().visible, 3 * counts().around);
      EXPECT_EQ(draw_in_windows(frame, 6, slabs).pixels, whole.pixels) << slabs;
      EXPECT_GE(counts().windows, 4u);
      EXPECT_EQ(draw(streamed(frame), slabs).pixels, whole.pixels) << slabs;
    }
  }
}

TEST_P(Windows, HoldCloudsAroundTheCameraInLists) {
  Frame frame = within_clouds(240, 100);
  for (const SortOrder::By by : {SortOrder::By::depth, SortOrder::By::field}) {
    frame.sort.by = by;
    give_few_fields(frame, 2);
    const Image whole = draw(frame, 0);
    EXPECT_GT(counts().in_lists, 5u);
    EXPECT_LE(largest_error(whole, reference::render(frame)), frame.tolerance);
    EXPECT_EQ(draw_in_windows(frame, 6, 0).pixels, whole.pixels);
    EXPECT_GE(counts().windows, 3u);
    EXPECT_EQ(draw(streamed(frame), 0).pixels, whole.pixels);
  }
}

// Of 1000 clouds, and of five blocks' in chunks of three, which are shorter than chunks may be.
TEST_P(Windows, DrawColumnsInPiecesToTheSameBits) {
  device().traits.chunk_blocks = 4;
  const int five_blocks = 5 * static_cast<int>(device().traits.project_block);
  for (const bool is_ordered : {false, true}) {
    for (const int count : {1000, five_blocks}) {
      const Frame frame = is_ordered ? many_clouds(count) : without_absorption(many_clouds(count));
      const Image whole = draw(frame);
      const DeviceTraits traits = device().traits;
      device().traits.largest_buffer = 3 * sizeof(float) * traits.project_block * 4;
      EXPECT_EQ(draw(frame).pixels, whole.pixels) << count << ", in order: " << is_ordered;
      device().traits = traits;
    }
  }
}

// As on a GPU, which has not room for all of them at one time.
TEST_P(Windows, DrawColumnsThatComeAndGoToTheSameBits) {
  const Frame frame = many_clouds(1000);
  const Image whole = draw(frame);
  device().traits.largest_buffer = 3 * sizeof(float) * 512;
  device().traits.shares_host_memory = false;
  device().memory.columns = 5 * sizeof(float) * 512;
  EXPECT_EQ(draw(frame).pixels, whole.pixels);
}

// Blocks of particles have room for all of theirs, however few a component has.
TEST_P(Windows, AreAskedForByTheRoomThatSplatsTake) {
  const Frame frame = many_clouds(1000);
  DeviceTraits traits = device().traits;
  traits.project_block = 8192;
  Frame of_many = frame;
  of_many.components.assign(100, frame.components.front());
  const std::uint64_t slots = splat_slots(of_many, make_plan(of_many), traits);
  EXPECT_EQ(slots, 100 * 8192u);
}

TEST_P(Windows, HaveNoMoreSplatsThanKernelsCount) {
  const Frame frame = many_clouds(100);
  const FramePlan plan = make_plan(frame);
  device().memory.total = std::uint64_t{1} << 44;
  device().traits.largest_buffer = std::uint64_t{1} << 43;
  EXPECT_LE(splat_capacity(StageContext(device(), frame, plan)), std::uint64_t{1} << 31);
}

TEST_P(Windows, DrawColumnsThatAreReadChunkByChunkToTheSameBits) {
  device().traits.chunk_blocks = 4;
  const int five_blocks = 5 * static_cast<int>(device().traits.project_block);
  for (const bool is_ordered : {false, true}) {
    for (const int count : {1000, five_blocks}) {
      const Frame frame = is_ordered ? many_clouds(count) : without_absorption(many_clouds(count));
      EXPECT_EQ(draw(streamed(frame)).pixels, draw(frame).pixels)
          << count << ", in order: " << is_ordered;
    }
  }
}

}  // namespace
}  // namespace splotchcl::test
