// The sort keys of the stage `project` are the oracle's, bit for bit.
#include "device/stages.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// The oracle's key as the device sorts it: smaller ones in front.
std::uint64_t ascending(std::uint64_t key, const SortOrder& sort) {
  const int bits = sort.by == SortOrder::By::depth ? 48 : 32;
  const std::uint64_t largest = (std::uint64_t{1} << bits) - 1;
  return sort.descending ? largest - key : key;
}

// Positions within `radius` of `centre`, stored relative to `origin`.
DrawnComponent ball(const Vec3& center, double radius, const Vec3& origin, std::size_t count,
                    std::uint64_t seed) {
  Random random(seed);
  std::vector<float> positions;
  for (std::size_t i = 0; i < 3 * count; ++i) {
    const double place = center.a[i % 3] + radius * random.uniform(-1, 1);
    positions.push_back(static_cast<float>(place - origin.a[i % 3]));
  }
  DrawnComponent component;
  component.particles.count = count;
  component.particles.origin = origin;
  component.particles.position = Column::owning(positions);
  component.particles.smoothing_length = Column::uniform(static_cast<float>(1e-3 * radius));
  component.particles.weight = Column::uniform(1);
  return component;
}

// A camera `distance` from the centre, in a direction that is no axis, that sees a ball of
// half that radius in full.
Frame seen_from(const Vec3& center, double distance, Projection projection,
                const std::vector<DrawnComponent>& components) {
  Camera camera;
  camera.look_at = center;
  camera.position = center + Vec3{{0.48, -0.6, 0.64}} * distance;
  camera.sky = {{0.3, 1, 0.2}};
  camera.field_of_view_degrees = 120;
  camera.projection = projection;
  Frame frame = frame_of(200, 200, components);
  frame.camera = make_camera_frame(camera, frame.width, frame.height);
  frame.projection = projection;
  return with_identities(frame);
}

void expect_keys_of_the_oracle(DeviceContext& device, const Frame& frame, bool lanes) {
  Stages stages(device, frame, lanes);
  stages.project();
  const std::vector<reference::Splat> expected = reference::project(stages.frame());
  const std::vector<shared::Splat> splats = stages.splats();
  const std::vector<std::uint64_t> keys = stages.keys();
  ASSERT_EQ(splats.size(), expected.size()) << "every particle should be in view";
  for (std::size_t i = 0; i < expected.size(); ++i) {
    ASSERT_EQ(identity_of(splats[i]), expected[i].particle);
    ASSERT_EQ(keys[i], ascending(expected[i].key, frame.sort))
        << "particle " << expected[i].particle << ", key " << expected[i].key;
  }
}

// Eight particles at a time, and one at a time as on a GPU.
class ProjectKeys : public StageTest, public testing::WithParamInterface<bool> {
 protected:
  void expect(const Frame& frame) const { expect_keys_of_the_oracle(device(), frame, GetParam()); }
};

TEST_P(ProjectKeys, EqualTheOraclesInPerspective) {
  const Vec3 center = {{120, -340, 560}};
  const DrawnComponent component = ball(center, 100, {{0, 0, 0}}, 5003, 1);
  expect(seen_from(center, 300, Projection::perspective, {component}));
}

TEST_P(ProjectKeys, EqualTheOraclesInOrthographicProjection) {
  const Vec3 center = {{120, -340, 560}};
  const DrawnComponent component = ball(center, 100, {{0, 0, 0}}, 5003, 2);
  expect(seen_from(center, 300, Projection::orthographic, {component}));
}

TEST_P(ProjectKeys, EqualTheOraclesForADistantOrigin) {
  const Vec3 center = {{1e8 + 0.1, -2e8, 3e8}};
  const DrawnComponent component = ball(center, 1, {{1e8, -2e8, 3e8}}, 5003, 3);
  expect(seen_from(center, 3, Projection::perspective, {component}));
}

TEST_P(ProjectKeys, EqualTheOraclesForDistantPositions) {
  const Vec3 center = {{1e8, -2e8, 3e8}};
  const DrawnComponent component = ball(center, 1e4, {{0, 0, 0}}, 5003, 4);
  expect(seen_from(center, 3e4, Projection::perspective, {component}));
}

TEST_P(ProjectKeys, EqualTheOraclesForComponentsWithOriginsOfTheirOwn) {
  const Vec3 center = {{0.3, 0.61, 0.74}};
  const DrawnComponent near = ball(center, 1e-6, center, 1001, 5);
  const DrawnComponent box = ball(center, 1e-6, {{0, 0, 0}}, 1001, 6);
  expect(seen_from(center, 3e-6, Projection::perspective, {near, box}));
}

TEST_P(ProjectKeys, TakeTheBitsOfAField) {
  using Limits = std::numeric_limits<float>;
  for (const bool descending : {false, true}) {
    DrawnComponent component = ball({{0, 0, 0}}, 1, {{0, 0, 0}}, 17, 7);
    component.particles.sort_field =
        Column::owning({0.0f, -0.0f, Limits::denorm_min(), -Limits::denorm_min(), 1e-40f, -1e-40f,
                        Limits::min(), -Limits::min(), Limits::max(), Limits::lowest(), 1.0f, -1.0f,
                        0.1f, -0.1f, 3e9f, -3e9f, 1.00000012f});
    Frame frame = seen_from({{0, 0, 0}}, 3, Projection::perspective, {component});
    frame.sort = {SortOrder::By::field, "key", descending};
    expect(frame);
  }
}

TEST_P(ProjectKeys, AreOneKeyForDepthsOfMinusAndPlusZero) {
  Frame frame = frame_of(20, 20, {component_of({{1, 2, 0.0}, {3, 4, -0.0}}, two_colors())});
  frame = with_identities(frame);
  Stages stages(device(), frame, GetParam());
  stages.project();
  const std::vector<std::uint64_t> keys = stages.keys();
  ASSERT_EQ(keys.size(), 2u);
  EXPECT_EQ(keys[0], keys[1]);
  expect(frame);
}

// Components with origins of their own, in a camera's box of any size, seen from anywhere.
Frame random_scene(Random& random, Projection projection, double size, double distance) {
  const Vec3 center = Vec3{{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}} *
                      (size * random.logarithmic(1e-3, 1e6));
  std::vector<DrawnComponent> components;
  for (const double origin : {0.0, 1.0, random.uniform(0, 2)}) {
    const auto seed = static_cast<std::uint64_t>(random.uniform(0, 1e6));
    components.push_back(ball(center, size, center * origin, 203, seed));
  }
  Frame frame = seen_from(center, distance * size, projection, components);
  frame.sort.descending = random.uniform() < 0.5;
  return frame;
}

TEST_P(ProjectKeys, EqualTheOraclesInScenesOfAnySize) {
  Random random(12);
  for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
    for (const double size : {1e-18, 1e-9, 1e-3, 1.0, 3e5, 1e12, 3e18})
      expect(random_scene(random, projection, size, 3));
  }
}

// A cloud so far away that positions relative to it would have no digits left for the others.
TEST_P(ProjectKeys, EqualTheOraclesBesideACloudFarAway) {
  for (const float distance : {1e6f, 1e12f, 1e19f, 1e30f, 3e38f}) {
    DrawnComponent component = ball({{0, 0, 0}}, 1, {{0, 0, 0}}, 1000, 8);
    std::vector<float> positions(component.particles.position.data(),
                                 component.particles.position.data() + 3000);
    positions.insert(positions.begin(), {0, 0, distance});
    component.particles.position = Column::owning(positions);
    component.particles.count = 1001;
    Frame frame = frame_of(200, 200, {component});
    frame.camera.position = {{0.1, 0.2, -3}};
    frame.camera.focal_pixels = 50;
    frame.projection = Projection::perspective;
    expect(with_identities(frame));
  }
}

INSTANTIATE_TEST_SUITE_P(Lanes, ProjectKeys, testing::Bool(), [](const auto& info) {
  return std::string(info.param ? "eight" : "one");
});

}  // namespace
}  // namespace splotchcl::test
