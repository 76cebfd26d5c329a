#include "load/placement.h"
#include "snapshot/memory_snapshot.h"
#include "splotchcl/load.h"
#include "splotchcl/reference.h"
#include "splotchcl/snapshot.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

double squared_distance(const std::array<double, 3>& a, const Vec3& b) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i)
    sum += (a[i] - b.a[i]) * (a[i] - b.a[i]);
  return sum;
}

// The nearest of the 125 images around.
std::array<double, 3> nearest_image(const std::array<double, 3>& x, const Vec3& center,
                                    double box) {
  std::array<double, 3> nearest = x;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 125; ++i) {
    const std::array<double, 3> image = {x[0] + box * (i % 5 - 2), x[1] + box * (i / 5 % 5 - 2),
                                         x[2] + box * (i / 25 - 2)};
    const double distance = squared_distance(image, center);
    if (distance < least) {
      least = distance;
      nearest = image;
    }
  }
  return nearest;
}

TEST(PeriodicWrap, FindsTheNearestOfAllImages) {
  constexpr double box = 50;
  std::mt19937 random(1);
  std::uniform_real_distribution<float> anywhere(0, 50);
  std::vector<float> position(3 * 5000);
  for (float& x : position)
    x = anywhere(random);
  const Vec3 origin = {{3, -4, 0.5}};
  for (const Vec3& center : {Vec3{{0, 0, 0}}, Vec3{{49.5, 20, 30.25}}, Vec3{{-20, 70, 25}}}) {
    const Column wrapped = wrapped_positions(Vec3(origin - center), box, Column::owning(position));
    for (std::size_t i = 0; i < 5000; ++i) {
      std::array<double, 3> before, after;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        before[axis] = origin.a[axis] + static_cast<double>(position[3 * i + axis]);
        after[axis] = center.a[axis] + static_cast<double>(wrapped[3 * i + axis]);
      }
      const std::array<double, 3> expected = nearest_image(before, center, box);
      for (std::size_t axis = 0; axis < 3; ++axis)
        ASSERT_NEAR(after[axis], expected[axis], 4e-6) << i;
    }
  }
}

// Wherever a stretch of a streamed column begins.
TEST(PeriodicWrap, FindsTheSameImagesManyAtOnceAsOneByOne) {
  const BoxSides box(Vec3{{1, 3, 1e-3}});
  const Vec3 shift = {{0.25, -7, 1e5}};
  std::mt19937 random(7);
  std::uniform_real_distribution<float> exponent(-20, 40);
  std::vector<float> position(3 * 700);
  for (float& x : position)
    x = std::exp2(exponent(random)) * (exponent(random) < 20 ? -1.0F : 1.0F);
  position[30] = 0.25F;   // half a side away
  position[33] = -0.75F;  // likewise
  position[37] = std::numeric_limits<float>::infinity();
  const Column stored = Column::owning(position);
  const Column wrapped = wrapped_positions(shift, box, stored, true);
  for (const std::size_t begin : {0U, 1U, 2U, 5U, 12U, 31U}) {
    std::vector<float> values(position.size() - begin - begin % 7);
    wrapped.source()->make(begin, begin + values.size(), values.data());
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::size_t axis = (begin + i) % 3;
      const double distance = static_cast<double>(position[begin + i]) + shift.a[axis];
      const auto expected = static_cast<float>(splotchcl::nearest_image(distance, box[axis]));
      ASSERT_TRUE(values[i] == expected || (std::isnan(values[i]) && std::isnan(expected)))
          << "value " << begin + i << " at " << position[begin + i];
    }
  }
}

TEST(PeriodicWrap, LeavesWhatIsNoNumber) {
  const Column position = Column::owning({std::numeric_limits<float>::quiet_NaN(), 1, 49});
  const Column wrapped = wrapped_positions({{0, 0, 0}}, 50, position);
  EXPECT_TRUE(std::isnan(wrapped[0]));
  EXPECT_EQ(wrapped[1], 1.0F);
  EXPECT_EQ(wrapped[2], -1.0F);
}

// Two clouds on either side of the box's face, seen from close to it.
class WrappedFrame : public ::testing::Test {
 protected:
  WrappedFrame() {
    snapshot.add(0, "position", {1, 5, 5, 99, 5, 5}, 3);
    snapshot.add(0, "mass", {1, 1});
    snapshot.add(0, "smoothing_length", {1, 1});
    snapshot.set_box_size(100);
    scene.image.width = 40;
    scene.image.height = 40;
    scene.camera.emplace();
    scene.camera->position = {{0, 5, -20}};
    scene.camera->look_at = {{0, 5, 5}};
    scene.camera->field_of_view_degrees = 30;
    scene.components.emplace_back();
    scene.components[0].reference_column = 0.1;
  }
  std::size_t clouds_in_view() {
    std::vector<std::string> notes;
    const Frame frame = load_frame(scene, snapshot, notes);
    std::size_t count = 0;
    for (const reference::Splat& splat : reference::project(frame))
      count += splat.x > 0 && splat.x < 40 ? 1U : 0U;
    return count;
  }
  MemorySnapshot snapshot;
  Scene scene;
};

TEST_F(WrappedFrame, ShowsBothSidesOfTheBoxesFace) {
  EXPECT_EQ(clouds_in_view(), 1U);
  scene.periodic.wrap = true;
  EXPECT_EQ(clouds_in_view(), 2U);
}

TEST_F(WrappedFrame, TakesTheBoxThatTheSceneSays) {
  scene.periodic.wrap = true;
  scene.periodic.box = 1000;
  EXPECT_EQ(clouds_in_view(), 1U);
}

TEST_F(WrappedFrame, HasTheSamePositionsForTheNextFrameOnlyAroundTheSameCenter) {
  scene.periodic.wrap = true;
  const auto load = [this] {
    std::vector<std::string> notes;
    return load_frame(scene, snapshot, notes).components[0].particles;
  };
  const Particles first = load(), second = load();
  EXPECT_EQ(first.position.data(), second.position.data());
  scene.camera->look_at.a[0] = 40;
  const Particles moved = load();
  EXPECT_EQ(moved.origin.a[0], 40);
  EXPECT_EQ(moved.position[0], -39);
  EXPECT_EQ(moved.position[3], -41);  // at -1
  scene.periodic.box = 60;
  EXPECT_EQ(load().position[3], -1);
  scene.camera->look_at.a[0] = 0;
  scene.periodic.box.reset();
  EXPECT_EQ(load().position[3], first.position[3]);
}

TEST(PeriodicBox, ThatNobodySaysIsRefused) {
  MemorySnapshot snapshot;
  EXPECT_THROW(periodic_box({true, {}}, snapshot.info()), UsageError);
  EXPECT_EQ(periodic_box({true, 7}, snapshot.info()), 7);
}

// Doubles that single precision cannot hold well enough are told of.

// Floats from 2^20 to 2^21 are 0.125 apart.
DrawnComponent component(const std::vector<float>& along_x, float h, double origin) {
  DrawnComponent component;
  component.name = "gas";
  std::vector<float> position, sizes;
  for (const float x : along_x) {
    position.insert(position.end(), {x, 0, 0});
    sizes.push_back(h);
  }
  component.particles.count = along_x.size();
  component.particles.origin = {{origin, 0, 0}};
  component.particles.position = Column::owning(std::move(position));
  component.particles.smoothing_length = Column::owning(std::move(sizes));
  return component;
}

std::optional<std::string> note_on(const DrawnComponent& component) {
  return tell_rounded_positions(component, ParticlePass(component.particles.count));
}

TEST(RoundedPositions, AreCountedWithTheWorst) {
  const auto note = note_on(component({1, 1.5e6F, 1.1e6F}, 0.5F, 3e7));
  ASSERT_TRUE(note);
  EXPECT_THAT(*note, HasSubstr("component gas: 2 of 3 particles"));
  EXPECT_THAT(*note, HasSubstr("at worst 0.25"));
}

TEST(RoundedPositions, MayBeATenthOfTheSizeThatIsDrawn) {
  EXPECT_FALSE(note_on(component({1.5e6F}, 1.25F, 3e7)));
  DrawnComponent smaller = component({1.5e6F}, 1.25F, 3e7);
  smaller.size_factor = 0.9;
  EXPECT_TRUE(note_on(smaller));
}

TEST(RoundedPositions, MayBeThereOnlyWhereTheFarthestAndTheSmallestTogetherWouldBe) {
  const DrawnComponent far = component({1, 1.5e6F}, 1.25F, 3e7);
  const PlaceExtremes extremes = find_extremes(far.particles, ParticlePass(far.particles.count));
  EXPECT_EQ(extremes.largest_offset, 1.5e6F);
  EXPECT_EQ(extremes.smallest_length, 1.25F);
  EXPECT_FALSE(may_be_rounded(extremes, 1));
  EXPECT_TRUE(may_be_rounded(extremes, 0.9));
}

TEST(RoundedPositions, OfFilesOfFloatsAreAsTheFileHasThem) {
  EXPECT_FALSE(note_on(component({1.5e6F}, 1e-3F, 0)));
}

}  // namespace
}  // namespace splotchcl::test
