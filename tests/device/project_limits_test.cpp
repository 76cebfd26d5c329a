#include <boost/qvm/vec_operations.hpp>

#include "device/stages.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

using namespace boost::qvm;

// Which particles the near and far limits leave out: those that the oracle leaves out.

// Particles on the view axis at these depths.
Frame frame_at_depths(const std::vector<float>& depths, Projection projection, float h) {
  std::vector<Cloud> clouds;
  for (const float z : depths)
    clouds.push_back({0, 0, static_cast<double>(z), static_cast<double>(h), 1});
  Frame frame = frame_of(20, 20, {component_of(clouds, two_colors())});
  frame.projection = projection;
  frame.camera.focal_pixels = 20;
  return with_identities(frame);
}

std::vector<float> around(float value) {
  constexpr float infinite = std::numeric_limits<float>::infinity();
  const float below = std::nextafterf(value, -infinite), above = std::nextafterf(value, infinite);
  return {std::nextafterf(below, -infinite), below, value, above, std::nextafterf(above, infinite)};
}

class ProjectLimits : public StageTest, public testing::WithParamInterface<bool> {
 protected:
  void expect_particles_of_the_oracle(const Frame& frame) const {
    Stages stages(device(), frame, GetParam());
    stages.project();
    std::vector<std::uint64_t> drawn, expected;
    for (const shared::Splat& splat : stages.splats())
      drawn.push_back(identity_of(splat));
    for (const reference::Splat& splat : reference::project(frame))
      expected.push_back(splat.particle);
    EXPECT_EQ(drawn, expected);
  }
};

TEST_P(ProjectLimits, AreInclusive) {
  for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
    std::vector<float> depths = around(0.5f);
    for (const float z : around(2.25f))
      depths.push_back(z);
    Frame frame = frame_at_depths(depths, projection, 0.01f);
    frame.near_limit = 0.5;
    frame.far_limit = 2.25;
    expect_particles_of_the_oracle(frame);
  }
}

TEST_P(ProjectLimits, MayLieBehindAnOrthographicCameraOnly) {
  for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
    Frame frame = frame_at_depths({-3, -2, -1, -1e-30f, -0.0f, 0, 1e-30f, 1}, projection, 0.01f);
    frame.near_limit = -2;
    expect_particles_of_the_oracle(frame);
  }
}

TEST_P(ProjectLimits, StartAtTheOrthographicCameraUnlessSet) {
  expect_particles_of_the_oracle(
      frame_at_depths({-1, -1e-45f, -0.0f, 0, 1e-45f, 1}, Projection::orthographic, 0.01f));
}

// A tenth of h rounds to a tenth of h in single precision or to its neighbour: particles
// three steps from it are decided alike.
TEST_P(ProjectLimits, StartAtATenthOfTheSmoothingLengthUnlessSet) {
  for (const float h : {1e-3f, 0.3f, 7.0f}) {
    const float limit = 0.1f * h;
    expect_particles_of_the_oracle(
        frame_at_depths({-limit, -0.0f, 0, 0.5f * limit, limit * (1 - 3e-7f), limit * (1 + 3e-7f),
                         2 * limit, 100 * limit},
                        Projection::perspective, h));
  }
}

TEST_P(ProjectLimits, HoldWhereSinglePrecisionCannotStoreThem) {
  // 0.7 and 1.1 round down and up: a particle at the rounded limit lies on one side of it.
  for (const double limit : {0.7, 1.1}) {
    Frame frame = frame_at_depths(around(static_cast<float>(limit)), Projection::orthographic, 1);
    frame.near_limit = limit;
    expect_particles_of_the_oracle(frame);
    frame.near_limit.reset();
    frame.far_limit = limit;
    expect_particles_of_the_oracle(frame);
  }
}

// Clouds around the camera, all of which lie at its near limit or its far limit to within what
// positions in single precision can tell.
Frame shell_at_limits(Projection projection, std::uint64_t seed) {
  Random random(seed);
  const Vec3 origin = Vec3{{1, -2, 3}} * random.logarithmic(1e-6, 1e6);
  const double distance = random.logarithmic(1e-3, 1e3);
  Camera camera;
  camera.position = origin + Vec3{{0.3, 0.2, -0.1}} * distance;
  camera.look_at = camera.position + Vec3{{0.4, -0.3, 0.8}} * (2 * distance);
  camera.projection = projection;
  const CameraFrame axes = make_camera_frame(camera, 40, 40);
  std::vector<float> positions;
  for (int i = 0; i < 400; ++i) {
    const double far_away = i % 2 == 0 ? 1 : 1.5;
    const double x = random.uniform(-0.2, 0.2), y = random.uniform(-0.2, 0.2);
    Vec3 place = axes.right * x + axes.down * y + axes.forward * far_away;
    if (is_wide_angle(projection))
      place *= far_away / std::sqrt(x * x + y * y + far_away * far_away);
    place = camera.position + place * (distance * (1 + random.uniform(-2e-7, 2e-7)));
    for (int axis = 0; axis < 3; ++axis)
      positions.push_back(static_cast<float>(place.a[axis] - origin.a[axis]));
  }
  DrawnComponent component;
  component.particles.count = positions.size() / 3;
  component.particles.origin = origin;
  component.particles.position = Column::owning(positions);
  component.particles.smoothing_length = Column::uniform(static_cast<float>(0.1 * distance));
  Frame frame = frame_of(40, 40, {component});
  frame.projection = projection;
  frame.camera = axes;
  frame.near_limit = distance;
  frame.far_limit = 1.5 * distance;
  return with_identities(frame);
}

constexpr Projection projections[] = {Projection::perspective, Projection::orthographic,
                                      Projection::fisheye, Projection::cube};

TEST_P(ProjectLimits, HoldWhereSinglePrecisionCannotTell) {
  for (const Projection projection : projections) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed)
      expect_particles_of_the_oracle(shell_at_limits(projection, seed));
  }
}

TEST_P(ProjectLimits, HoldInExtendedPrecision) {
  for (const Projection projection : projections) {
    Frame frame = shell_at_limits(projection, 11);
    frame.tolerance = 0;
    expect_particles_of_the_oracle(frame);
  }
}

// The nearest that a cloud may be follows from its own width.
TEST_P(ProjectLimits, HoldForSmoothingLengthsThatReachTheCamera) {
  for (const Projection projection : projections) {
    Frame frame = shell_at_limits(projection, 12);
    DrawnComponent& component = frame.components.front();
    Random random(13);
    std::vector<float> lengths;
    for (std::size_t i = 0; i < component.particles.count; ++i) {
      lengths.push_back(static_cast<float>(*frame.near_limit * (i % 2 == 0 ? 1 : 1.5) *
                                           (1 + random.uniform(-2e-7, 2e-7))));
    }
    component.particles.smoothing_length = Column::owning(lengths);
    component.size_factor = 10;
    frame.near_limit.reset();
    frame.far_limit.reset();
    expect_particles_of_the_oracle(frame);
  }
}

// A cloud exactly at a limit is drawn, one that is the least bit beyond it is not.
TEST_P(ProjectLimits, TellOneFloatFromTheNext) {
  for (const Projection projection : projections) {
    for (const float limit : {0.1f, 0.7f, 3e5f}) {
      Frame frame = frame_at_depths(around(limit), projection, 0.01f * limit);
      frame.camera.look_at_distance = 2.0 * static_cast<double>(limit);
      frame.near_limit = limit;
      expect_particles_of_the_oracle(frame);
      EXPECT_EQ(reference::project(frame).size(), 3u) << limit;
      frame.near_limit.reset();
      frame.far_limit = limit;
      expect_particles_of_the_oracle(frame);
      EXPECT_EQ(reference::project(frame).size(), 3u) << limit;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Lanes, ProjectLimits, testing::Bool(), [](const auto& info) {
  return std::string(info.param ? "eight" : "one");
});

// Particles with bad values are counted as the oracle counts them, and leave no trace.

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr std::size_t particle_total = 21;  // no multiple of eight

// Clouds with every column present.
DrawnComponent full_component() {
  CloudSetup setup;
  setup.count = static_cast<int>(particle_total);
  DrawnComponent component = random_clouds(setup);
  component.particles.intensity = Column::owning(std::vector<float>(particle_total, 0.7f));
  component.particles.sort_field = Column::owning(std::vector<float>(particle_total, 3.0f));
  return component;
}

struct Field {
  std::string name;
  Column Particles::*column;
  std::size_t stride, offset;
};

std::vector<Field> all_fields() {
  return {{"x", &Particles::position, 3, 0},
          {"y", &Particles::position, 3, 1},
          {"z", &Particles::position, 3, 2},
          {"smoothing length", &Particles::smoothing_length, 1, 0},
          {"weight", &Particles::weight, 1, 0},
          {"color", &Particles::color, 1, 0},
          {"intensity", &Particles::intensity, 1, 0},
          {"sort field", &Particles::sort_field, 1, 0}};
}

void set_value(DrawnComponent& component, const Field& field, std::size_t particle, float value) {
  Column& column = component.particles.*field.column;
  std::vector<float> values(column.data(), column.data() + column.size());
  values[particle * field.stride + field.offset] = value;
  column = Column::owning(values);
}

std::uint64_t count_of_device(DeviceContext& device, const Frame& frame, bool lanes) {
  Stages stages(device, frame, lanes);
  stages.project();
  return stages.keyed().particles.bad;
}

class BadValues : public StageTest, public testing::WithParamInterface<bool> {
 protected:
  void expect_bad(const DrawnComponent& component, std::uint64_t expected) {
    const Frame frame = frame_of(100, 70, {component});
    EXPECT_EQ(reference::count_bad(frame), expected);
    EXPECT_EQ(count_of_device(device(), frame, GetParam()), expected);
  }
};

TEST_P(BadValues, AreCountedInEveryField) {
  for (const Field& field : all_fields()) {
    for (const float value : {nan, infinite, -infinite}) {
      SCOPED_TRACE(field.name + " = " + std::to_string(value));
      DrawnComponent component = full_component();
      // The first, one in the middle and the last particle.
      set_value(component, field, 0, value);
      set_value(component, field, 12, value);
      set_value(component, field, particle_total - 1, value);
      expect_bad(component, 3);
    }
  }
}

TEST_P(BadValues, AreSmoothingLengthsThatAreNotPositiveAndNegativeWeights) {
  const std::vector<Field> fields = all_fields();
  const Field& size = fields[3];
  const Field& weight = fields[4];
  constexpr float denormal = std::numeric_limits<float>::denorm_min();
  DrawnComponent component = full_component();
  set_value(component, size, 1, 0.0f);
  set_value(component, size, 2, -0.0f);
  set_value(component, size, 3, -1.0f);
  set_value(component, size, 4, -denormal);
  set_value(component, weight, 5, -1.0f);
  set_value(component, weight, 6, -denormal);
  set_value(component, weight, 7, -0.0f);  // is zero: good
  set_value(component, weight, 8, 0.0f);   // good
  set_value(component, size, 9, 1e-37f);   // good
  expect_bad(component, 6);
}

TEST_P(BadValues, AreCountedWhereverTheyLie) {
  DrawnComponent component = full_component();
  for (std::size_t i = 0; i < particle_total; ++i)
    set_value(component, all_fields()[0], i, 1e6f);  // far off the picture
  set_value(component, all_fields()[4], 5, nan);
  set_value(component, all_fields()[2], 6, nan);
  expect_bad(component, 2);
}

TEST_P(BadValues, OfAUniformColumnMakeEveryParticleBad) {
  DrawnComponent component = full_component();
  component.particles.smoothing_length = Column::uniform(nan);
  expect_bad(component, particle_total);
  component.particles.smoothing_length = Column::uniform(2);
  expect_bad(component, 0);
}

TEST_P(BadValues, AreCountedOncePerParticle) {
  DrawnComponent component = full_component();
  for (const Field& field : all_fields())
    set_value(component, field, 11, nan);
  expect_bad(component, 1);
}

TEST_P(BadValues, OfAnAbsentColumnAreNone) {
  DrawnComponent component = full_component();
  component.particles.weight = Column();
  component.particles.color = Column();
  component.particles.intensity = Column();
  component.particles.sort_field = Column();
  component.weight = WeightModel::constant;
  expect_bad(component, 0);
}

INSTANTIATE_TEST_SUITE_P(Lanes, BadValues, testing::Bool(), [](const auto& info) {
  return std::string(info.param ? "eight" : "one");
});

}  // namespace
}  // namespace splotchcl::test
