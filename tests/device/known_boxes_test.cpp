// Boxes that are known before particles are read: what is out of view is left out in the first
// frame, and is not read.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "device/counted_column.h"
#include "device/pictures.h"
#include "device/scene_maker.h"
#include "device/stages.h"

namespace splotchcl::test {
namespace {

constexpr std::size_t block_particles = 32;
constexpr std::size_t particles_in_view = 1000;

std::shared_ptr<const ParticleBoxes> boxes_of(const Particles& particles) {
  ParticleBoxes boxes;
  boxes.block_particles = block_particles;
  for (std::size_t begin = 0; begin < particles.count; begin += block_particles) {
    ParticleBox box = {{1e30f, 1e30f, 1e30f}, {-1e30f, -1e30f, -1e30f}, 0};
    for (std::size_t i = begin; i < std::min(particles.count, begin + block_particles); ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        box.lower[axis] = std::min(box.lower[axis], particles.position[3 * i + axis]);
        box.upper[axis] = std::max(box.upper[axis], particles.position[3 * i + axis]);
      }
      box.largest_smoothing_length =
          std::max(box.largest_smoothing_length, particles.smoothing_length[i]);
    }
    boxes.boxes.push_back(box);
  }
  return std::make_shared<const ParticleBoxes>(std::move(boxes));
}

// Clouds in view, and before them in the file twice as many that lie far beside it.
Frame scene(bool is_ordered) {
  CloudSetup setup;
  setup.count = 3 * static_cast<int>(particles_in_view);
  DrawnComponent clouds = random_clouds(setup);
  Particles& particles = clouds.particles;
  std::vector<float> positions(particles.position.data(),
                               particles.position.data() + particles.position.size());
  for (std::size_t i = 0; i < particles.count - particles_in_view; ++i)
    positions[3 * i] += 5000;
  particles.position = Column::owning(std::move(positions));
  if (is_ordered) clouds.absorption = {Absorption::Kind::gray, 0.2};
  return frame_of(setup.width, setup.height, {clouds});
}

class KnownBoxes : public StageTest, public testing::WithParamInterface<std::tuple<bool, bool>> {
 protected:
  void SetUp() override {
    choose_shape(device().traits, std::get<0>(GetParam()));
    whole_ = device().traits;
    device().traits.project_block = std::get<0>(GetParam()) ? block_particles : GROUP_ITEMS;
    device().traits.chunk_blocks = 8;
  }
  void TearDown() override { device().traits = whole_; }

  bool is_ordered() const { return std::get<1>(GetParam()); }

  Image draw(const Frame& frame) {
    DrawnOnce drawn = draw_with_plan(device(), frame, make_plan(frame));
    counts_ = drawn.counts;
    return std::move(drawn.image);
  }
  const DrawCounts& counts() const { return counts_; }

 private:
  DeviceTraits whole_;
  DrawCounts counts_;
};

INSTANTIATE_TEST_SUITE_P(Shapes, KnownBoxes, testing::Combine(testing::Bool(), testing::Bool()),
                         [](const auto& info) {
                           return std::string(std::get<0>(info.param) ? "rows" : "groups") +
                                  (std::get<1>(info.param) ? "_ordered" : "_sums");
                         });

TEST_P(KnownBoxes, LeaveOutBlocksOfAFirstFrameAndChangeNoBit) {
  Frame frame = scene(is_ordered());
  const Image without = draw(frame);
  EXPECT_EQ(counts().blocks_left_out, 0u);
  const std::uint64_t visible = counts().visible;
  Particles& particles = frame.components.front().particles;
  particles.boxes = boxes_of(particles);
  const Image with = draw(frame);
  EXPECT_EQ(with.pixels, without.pixels);
  EXPECT_EQ(counts().visible, visible);
  const std::size_t blocks_beside = 2 * particles_in_view / device().traits.project_block;
  EXPECT_GE(counts().blocks_left_out + 1, blocks_beside);
}

TEST_P(KnownBoxes, KeepWhatIsOutOfViewUnread) {
  Frame frame = scene(is_ordered());
  const Image in_memory = draw(frame);
  Particles& particles = frame.components.front().particles;
  particles.boxes = boxes_of(particles);
  const auto lengths = std::make_shared<const CountedColumn>(particles.smoothing_length);
  particles.smoothing_length = Column::made_by(lengths);
  const FramePlan plan = make_plan(frame);
  const std::size_t before = lengths->made();
  EXPECT_EQ(draw(frame).pixels, in_memory.pixels);
  // Once for the plan within; once, in windows of keys and in order twice, for the projection.
  const std::size_t passes = is_ordered() ? 3 : 1;
  const std::size_t in_view = particles_in_view + device().traits.project_block;
  EXPECT_LE(lengths->made() - before, before + passes * in_view);
}

TEST(ParticleBoxes, AroundAStretchHoldAllOfItsBlocks) {
  const ParticleBoxes boxes = {
      10, {{{0, 0, 0}, {1, 1, 1}, 2}, {{5, -1, 0}, {6, 1, 1}, 1}, {{9, 9, 9}, {9, 9, 9}, 7}}};
  const ParticleBox both = boxes.around(9, 11);
  EXPECT_EQ(both.lower[0], 0);
  EXPECT_EQ(both.lower[1], -1);
  EXPECT_EQ(both.upper[0], 6);
  EXPECT_EQ(both.largest_smoothing_length, 2);
  EXPECT_EQ(boxes.around(10, 20).lower[0], 5);
}

}  // namespace
}  // namespace splotchcl::test
