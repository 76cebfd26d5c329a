// Which particles the near and far limits leave out: those that the oracle leaves out.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "device/stages.h"

namespace splotchcl::test {
namespace {

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

INSTANTIATE_TEST_SUITE_P(Lanes, ProjectLimits, testing::Bool(), [](const auto& info) {
  return std::string(info.param ? "eight" : "one");
});

}  // namespace
}  // namespace splotchcl::test
