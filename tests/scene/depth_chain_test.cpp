#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "splotchcl/frame.h"

namespace splotchcl {
namespace {

// frame.h's formula, each operation rounded to single precision.
float depth(const DepthChain& chain, const float (&p)[3]) {
  float d[3];
  for (int axis = 0; axis < 3; ++axis) {
    d[axis] = (p[axis] - chain.position_high[axis]) - chain.position_low[axis];
  }
  return (d[0] * chain.forward[0] + d[1] * chain.forward[1]) + d[2] * chain.forward[2];
}

CameraFrame frame_at(const Vec3& position, const Vec3& look_at) {
  Camera camera;
  camera.position = position;
  camera.look_at = look_at;
  camera.sky = {{0.3, 1, 0.2}};
  return make_camera_frame(camera, 100, 100);
}

TEST(DepthChain, HoldsTheCameraToTwiceSinglePrecision) {
  const Vec3 position = {{50000.123456789, -1e-3 / 3, 1e7 / 7}};
  const DepthChain chain = make_depth_chain(frame_at(position, {{0, 0, 0}}), {{0, 0, 0}});
  for (int axis = 0; axis < 3; ++axis) {
    const double held = static_cast<double>(chain.position_high[axis]) +
                        static_cast<double>(chain.position_low[axis]);
    // Each part is rounded to 24 bits: 2^-25 of what it holds.
    EXPECT_NEAR(held, position.a[axis], std::ldexp(std::abs(position.a[axis]), -49));
  }
}

TEST(DepthChain, TakesTheCameraRelativeToTheOrigin) {
  const Vec3 origin = {{1e6, 2e6, 3e6}};
  const CameraFrame camera = frame_at({{1e6 + 1, 2e6 + 2, 3e6 + 4}}, {{1e6, 2e6, 3e6}});
  const DepthChain chain = make_depth_chain(camera, origin);
  EXPECT_EQ(chain.position_high[0], 1);
  EXPECT_EQ(chain.position_high[1], 2);
  EXPECT_EQ(chain.position_high[2], 4);
  EXPECT_EQ(chain.position_low[2], 0);
}

// The error is a small part of the distance to the camera, however large the coordinates.
TEST(DepthChain, IsExactToAFewRoundingsOfTheDistance) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> box(0, 50000), unit(-1, 1), size(-4, 4);
  for (int i = 0; i < 10000; ++i) {
    const Vec3 position = {{box(random), box(random), box(random)}};
    const double distance = std::pow(10, size(random));
    const float p[3] = {static_cast<float>(position.a[0] + distance * unit(random)),
                        static_cast<float>(position.a[1] + distance * unit(random)),
                        static_cast<float>(position.a[2] + distance * unit(random))};
    const CameraFrame camera = frame_at(position, {{box(random), box(random), box(random)}});
    double exact = 0, reach = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double d = static_cast<double>(p[axis]) - position.a[axis];
      exact += d * camera.forward.a[axis];
      reach += std::abs(d);
    }
    const float z = depth(make_depth_chain(camera, {{0, 0, 0}}), p);
    // Two roundings in d, one each in the axis, the product and two sums, 2^-24 of the
    // distance each; and what the camera's two parts leave out, 2^-49 of 50000 per axis.
    const double bound = 6 * std::ldexp(reach, -24) + 4 * 50000 * std::ldexp(1, -47);
    EXPECT_NEAR(static_cast<double>(z), exact, bound);
  }
}

TEST(DepthChain, GrowsAlongTheViewDirection) {
  const DepthChain chain = make_depth_chain(frame_at({{1, 2, 3}}, {{4, 6, 3}}), {{0, 0, 0}});
  float last = -1;
  for (int step = 0; step < 100; ++step) {
    const float t = static_cast<float>(step);
    const float p[3] = {1 + 3 * t, 2 + 4 * t, 3};
    EXPECT_GT(depth(chain, p), last);
    last = depth(chain, p);
  }
}

}  // namespace
}  // namespace splotchcl
