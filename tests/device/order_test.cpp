// Project and sort together give the oracle's order, index for index.
#include "device/stages.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// Clouds in the picture at the depths that `depth(random)` draws.
template <class Depth>
DrawnComponent clouds_at(Depth depth, int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Cloud> clouds;
  for (int i = 0; i < count; ++i) {
    const double z = depth(random);
    clouds.push_back({random.uniform(-20, 20), random.uniform(-20, 20), z, 1, 1});
  }
  return component_of(clouds, two_colors());
}

// Depths far from each other, and depths of which many are equal.
double any_depth(Random& random) {
  return random.logarithmic(1e-3, 1e6);
}
double one_of_ten_depths(Random& random) {
  return std::floor(random.uniform(0, 10));
}

// Sort keys around zero, of which many are equal.
Column field_values(std::size_t count) {
  Random random(9);
  std::vector<float> values;
  for (std::size_t i = 0; i < count; ++i) {
    const double value = std::floor(random.uniform(-50, 50)) / 8;
    values.push_back(i % 7 == 0 ? -0.0f : static_cast<float>(value));
  }
  return Column::owning(values);
}

using Order = StageTest;

TEST_F(Order, IsTheOraclesForAnyDepths) {
  expect_order_of_the_oracle(device(), frame_of(50, 50, {clouds_at(any_depth, 30011, 1)}));
}

TEST_F(Order, IsTheOraclesWhereManyDepthsAreEqual) {
  expect_order_of_the_oracle(device(), frame_of(50, 50, {clouds_at(one_of_ten_depths, 30011, 2)}));
}

TEST_F(Order, IsTheOraclesFarToNear) {
  Frame frame = frame_of(50, 50, {clouds_at(one_of_ten_depths, 30011, 3)});
  frame.sort.descending = true;
  expect_order_of_the_oracle(device(), frame);
}

TEST_F(Order, IsTheOraclesByAField) {
  for (const bool descending : {false, true}) {
    DrawnComponent component = clouds_at(any_depth, 30011, 4);
    component.particles.sort_field = field_values(component.particles.count);
    Frame frame = frame_of(50, 50, {component});
    frame.sort = {SortOrder::By::field, "key", descending};
    expect_order_of_the_oracle(device(), frame);
  }
}

// Two clouds on the view axis, the farther one first in the file, `step` behind the nearer one.
// `origin` is where their component's positions start.
Frame two_clouds(Projection projection, double distance, double step, const Vec3& origin) {
  DrawnComponent clouds = component_of({{0, 0, step}, {0, 0, 0}}, two_colors());
  clouds.particles.origin = origin;
  clouds.particles.smoothing_length = Column::uniform(static_cast<float>(0.01 * distance));
  Camera camera;
  camera.look_at = origin;
  camera.position = origin - Vec3{{0, 0, 1}} * distance;
  camera.projection = projection;
  Frame frame = frame_of(50, 50, {clouds});
  frame.projection = projection;
  frame.camera = make_camera_frame(camera, frame.width, frame.height);
  return frame;
}

TEST_F(Order, IsRightForDepthsThatSinglePrecisionCannotTell) {
  for (const Projection projection :
       {Projection::perspective, Projection::orthographic, Projection::fisheye, Projection::cube}) {
    for (const double scale : {1e-18, 1.0, 1e18}) {
      const Frame frame =
          two_clouds(projection, 1e5 * scale, 1e-3 * scale, Vec3{{1e4, 1e4, 1e4}} * scale);
      Stages stages(device(), with_identities(frame));
      EXPECT_EQ(stages.sorted_particles(), (std::vector<std::uint64_t>{1, 0}))
          << static_cast<int>(projection) << ", " << scale;
    }
  }
}

TEST_F(Order, IsRightFarFromTheCoordinatesZero) {
  for (const Projection projection : {Projection::perspective, Projection::fisheye}) {
    const Frame frame = two_clouds(projection, 1e5, 1e-3, {{1e9, -1e9, 1e9}});
    Stages stages(device(), with_identities(frame));
    EXPECT_EQ(stages.sorted_particles(), (std::vector<std::uint64_t>{1, 0}));
  }
}

// Whatever else there is in the scene.
TEST_F(Order, IsRightBesideACloudFarAway) {
  Frame frame = two_clouds(Projection::perspective, 1e5, 1e-3, {{1e4, 1e4, 1e4}});
  frame.components.push_back(component_of({{0, 0, 1e30}}, two_colors()));
  Stages stages(device(), with_identities(frame));
  EXPECT_EQ(stages.sorted_particles().front(), 1u);
}

TEST_F(Order, OfACropIsThePictures) {
  Frame frame = with_identities(frame_of(50, 50, {clouds_at(any_depth, 3001, 8)}));
  const std::vector<std::uint64_t> all = Stages(device(), frame).sorted_particles();
  frame.crop = {20, 10, 7, 9};
  const std::vector<std::uint64_t> crop = Stages(device(), frame).sorted_particles();
  ASSERT_GT(crop.size(), 10u);
  ASSERT_LT(crop.size(), all.size());
  auto next = all.begin();
  for (const std::uint64_t particle : crop) {
    next = std::find(next, all.end(), particle);
    ASSERT_NE(next, all.end()) << "particle " << particle << " comes too early";
  }
}

// Blocks of the projection end inside components, and ties must keep components apart.
TEST_F(Order, IsTheOraclesAcrossComponents) {
  expect_order_of_the_oracle(
      device(), frame_of(50, 50,
                         {clouds_at(one_of_ten_depths, 9001, 5), clouds_at(one_of_ten_depths, 1, 6),
                          clouds_at(one_of_ten_depths, 20003, 7)}));
}

}  // namespace
}  // namespace splotchcl::test
