#include "device/drawings.h"
#include "device/frame/particle_store.h"
#include "device/pictures.h"
#include "device/pipeline.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// What a renderer has drawn before does not show in what it draws next.

class ChangedArrays : public PictureTest, public testing::WithParamInterface<bool> {
 protected:
  // As renderers do, frame by frame.
  static Image draw_next(DeviceContext& device, ParticleStore& store, const Frame& frame) {
    const std::uint64_t number = store.begin_frame();
    const FramePlan plan = make_plan(frame);
    Image image = Pipeline(device, store, frame, plan).draw();
    device.queue.finish();
    store.end_frame(number);
    return image;
  }
};

INSTANTIATE_TEST_SUITE_P(Memory, ChangedArrays, testing::Bool(), [](const auto& info) {
  return info.param ? "of_the_host" : "of_the_device";
});

TEST_P(ChangedArrays, AreDrawnAsTheyAreNow) {
  DeviceContext device(choose_device(""));
  device.traits.shares_host_memory &= GetParam();
  ParticleStore store(device);
  std::vector<float> places(3 * 100, 0.5f);
  Frame frame = frame_of(16, 12, {component_of(std::vector<Cloud>(100, Cloud{}), two_colors())});
  frame.components.front().particles.position = Column(nullptr, places.data(), places.size());
  EXPECT_GT(sum_of_light(draw_next(device, store, frame)), 0);
  for (float& place : places)
    place = 1e6f;
  EXPECT_EQ(sum_of_light(draw_next(device, store, frame)), 0);
}

TEST(ParticleStore, KeepsNoBufferOfAValueThatNoFrameAsksFor) {
  DeviceContext device(choose_device(""));
  ParticleStore store(device);
  Particles particles;
  particles.count = 1;
  const auto draw_with = [&](float weight) {
    const std::uint64_t number = store.begin_frame();
    particles.weight = Column::uniform(weight);
    const compute::buffer buffer = store.get(particles, {0, 0, 1}).weight;
    store.end_frame(number);
    return buffer;
  };
  const compute::buffer first = draw_with(5);
  EXPECT_EQ(draw_with(5), first);
  const auto users = first.reference_count();
  draw_with(6);
  EXPECT_EQ(first.reference_count(), users - 1);
}

TEST_F(PictureTest, AfterValuesThatAreNoNumbersIsAsBefore) {
  Frame frame = frame_of(16, 12, {component_of(std::vector<Cloud>(100, Cloud{}), two_colors())});
  const Image before = draw(frame);
  Frame bad = frame;
  bad.components.front().particles.weight =
      Column::uniform(std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(sum_of_light(draw(bad)), 0);
  EXPECT_EQ(renderer().stats().bad_particles, 100u);
  EXPECT_EQ(draw(frame).pixels, before.pixels);
}

// Frames filled by hand that no renderer can draw, which scenes refuse before.

class RefusedFrames : public PictureTest {
 protected:
  Frame frame_ = frame_of(20, 10, {component_of({Cloud{}}, one_color(1, 1, 1))});
};

TEST_F(RefusedFrames, HaveACropBesideThePicture) {
  frame_.crop = {15, 0, 6, 10};
  EXPECT_THROW(draw(frame_), UsageError);
}

TEST_F(RefusedFrames, HaveSidesThatKernelsCannotCount) {
  frame_.width = 65537;
  EXPECT_THROW(draw(frame_), UsageError);
}

TEST_F(RefusedFrames, HaveMorePixelsThanKernelsCanCount) {
  frame_.width = frame_.height = 65536;
  frame_.crop = {0, 0, 65536, 65536};
  EXPECT_THROW(draw(frame_), UsageError);
}

constexpr int side = BlockErrors::block_pixels;
constexpr double promise = 1e-3;

// A picture of 40 by 30 blocks, but for half a one at the right and at the bottom.
constexpr int picture_width = 40 * side - side / 2, picture_height = 30 * side - side / 2;

BlockErrors failing_at(const std::vector<std::pair<int, int>>& places) {
  BlockErrors blocks(picture_width, picture_height);
  for (const auto& [x, y] : places)
    blocks.errors[static_cast<std::size_t>(y * blocks.columns + x)] = 2e-3F;
  return blocks;
}

// Where another part costs as much as so many blocks.
std::vector<Rectangle> parts_of(const std::vector<std::pair<int, int>>& places,
                                int blocks_of_part = 20) {
  return failing_parts(failing_at(places), promise, picture_width, picture_height,
                       blocks_of_part * side * side);
}

double pixels(const std::vector<Rectangle>& parts) {
  double sum = 0;
  for (const Rectangle& part : parts)
    sum += static_cast<double>(part.width) * part.height;
  return sum;
}

TEST(FailingParts, AreNoneWhereAllBlocksKeepThePromise) {
  EXPECT_TRUE(parts_of({}).empty());
}

TEST(FailingParts, AreTheBoundsOfBlocksThatLieTogether) {
  const std::vector<Rectangle> parts = parts_of({{3, 4}, {5, 4}, {4, 6}});
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_EQ(parts[0].x, 3 * side);
  EXPECT_EQ(parts[0].y, 4 * side);
  EXPECT_EQ(parts[0].width, 3 * side);
  EXPECT_EQ(parts[0].height, 3 * side);
}

TEST(FailingParts, EndWithThePicture) {
  const std::vector<Rectangle> parts = parts_of({{39, 29}});
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_EQ(parts[0].x + parts[0].width, picture_width);
  EXPECT_EQ(parts[0].y + parts[0].height, picture_height);
}

TEST(FailingParts, AreSeparateForBlocksFarFromEachOther) {
  const std::vector<Rectangle> parts = parts_of({{0, 0}, {1, 1}, {38, 28}, {39, 29}});
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_LE(pixels(parts), 8 * side * side);
}

TEST(FailingParts, AreAsManyAsPay) {
  const std::vector<std::pair<int, int>> places = {{0, 0}, {4, 4}, {39, 0}, {39, 29}};
  EXPECT_EQ(parts_of(places, 0).size(), 4U);
  EXPECT_EQ(parts_of(places, 24).size(), 3U) << "25 blocks as one part, 2 as two";
  EXPECT_EQ(parts_of(places, 40 * 30).size(), 1U);
}

TEST(FailingParts, AreNoMoreThanTheirPixelsWhereTheyLieApart) {
  std::vector<std::pair<int, int>> places;
  for (int y = 0; y < 30; y += 5) {
    for (int x = y % 10; x < 40; x += 10)
      places.emplace_back(x, y);
  }
  const std::vector<Rectangle> parts = parts_of(places, 0);
  EXPECT_EQ(parts.size(), places.size());
  EXPECT_LE(pixels(parts), static_cast<double>(places.size()) * side * side);
}

TEST(FailingParts, AreAtMostSixtyFour) {
  std::vector<std::pair<int, int>> places;
  for (int y = 0; y < 30; y += 2) {
    for (int x = 0; x < 40; x += 2)
      places.emplace_back(x, y);
  }
  EXPECT_EQ(parts_of(places, 0).size(), 64U);
}

TEST(FailingParts, HoldEveryBlockThatFails) {
  const std::vector<std::pair<int, int>> places = {{0, 0}, {39, 0}, {0, 29}, {39, 29}, {20, 15}};
  const std::vector<Rectangle> parts = parts_of(places);
  for (const auto& [x, y] : places) {
    int holding = 0;
    for (const Rectangle& part : parts) {
      holding += x * side >= part.x && x * side < part.x + part.width && y * side >= part.y &&
                 y * side < part.y + part.height;
    }
    EXPECT_EQ(holding, 1) << x << ", " << y;
  }
}

}  // namespace
}  // namespace splotchcl::test
