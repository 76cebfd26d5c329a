// The keys of depths beside depths in higher precision.
#include "reference/depth_key.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "reference/frames.h"

namespace splotchcl::test {
namespace {

using reference::Depth;
using reference::depth_of;
using reference::is_within_limits;

constexpr std::uint64_t zero_depth = std::uint64_t{1} << 47;

class Scene {
 public:
  explicit Scene(unsigned seed) : random_(seed) {}

  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  Vec3 direction() { return {{between(-1, 1), between(-1, 1), between(-1, 1)}}; }

  // A camera that looks at something of this size, and a component that starts anywhere there.
  Frame frame(Projection projection, double size) {
    Camera camera;
    camera.position = scaled(direction(), size);
    camera.look_at = scaled(direction(), size);
    camera.sky = {{0.3, 1, 0.2}};
    camera.projection = projection;
    Frame frame = frame_of(10, 10, {component_of({}, one_color(1, 1, 1))});
    frame.projection = projection;
    frame.camera = make_camera_frame(camera, 10, 10);
    frame.components[0].particles.origin = scaled(direction(), size);
    return frame;
  }

  static Vec3 scaled(Vec3 v, double factor) {
    for (double& axis : v.a)
      axis *= factor;
    return v;
  }

 private:
  std::mt19937 random_;
};

// In more digits than a double has, where the machine has them.
struct ExactDepth {
  long double z = 0, distance = 0;
};

ExactDepth exact_depth(const float (&position)[3], const Frame& frame) {
  ExactDepth depth;
  for (int axis = 0; axis < 3; ++axis) {
    const long double d = static_cast<long double>(frame.components[0].particles.origin.a[axis]) -
                          static_cast<long double>(frame.camera.position.a[axis]) +
                          static_cast<long double>(position[axis]);
    depth.z += d * static_cast<long double>(frame.camera.forward.a[axis]);
    depth.distance += d * d;
  }
  depth.distance = std::sqrt(depth.distance);
  return depth;
}

// What a key stands for, in lengths or their squares.
long double decoded(std::uint64_t magnitude, int unit) {
  const auto exponent = static_cast<int>(magnitude >> 40);
  const int beyond = exponent > 0 ? exponent - 1 : 0;
  const auto leading =
      static_cast<long double>(magnitude - (static_cast<std::uint64_t>(beyond) << 40));
  return std::ldexp(leading, beyond + unit);
}

TEST(DepthKey, HasFortyBitsOfZ) {
  Scene scene(1);
  for (const double size : {1e-30, 1e-9, 1.0, 1e5, 1e24, 1e30}) {
    for (int i = 0; i < 1000; ++i) {
      const Frame frame = scene.frame(Projection::orthographic, size);
      const DepthKeyScale scale = make_depth_key_scale(frame, frame.components[0]);
      const Vec3 offset = Scene::scaled(scene.direction(), size);
      const float position[3] = {static_cast<float>(offset.a[0]), static_cast<float>(offset.a[1]),
                                 static_cast<float>(offset.a[2])};
      const ExactDepth exact = exact_depth(position, frame);
      const std::uint64_t key = depth_of(position, scale).key;
      const long double z = key >= zero_depth ? decoded(key - zero_depth, scale.finest_unit)
                                              : -decoded(zero_depth - key, scale.finest_unit);
      // The key is rounded, and the unit; and a long double may be a double.
      const double bound =
          std::ldexp(std::abs(static_cast<double>(exact.z)), -40) + std::ldexp(size, -48);
      EXPECT_NEAR(static_cast<double>(z - exact.z), 0, bound) << size;
    }
  }
}

TEST(DepthKey, HasFortyBitsOfTheDistance) {
  Scene scene(2);
  for (const double size : {1e-30, 1e-9, 1.0, 1e5, 1e24, 1e30}) {
    for (int i = 0; i < 1000; ++i) {
      const Frame frame = scene.frame(Projection::fisheye, size);
      const DepthKeyScale scale = make_depth_key_scale(frame, frame.components[0]);
      // Right before the camera as well, where squares have the fewest digits.
      const double reach = size * std::pow(10.0, scene.between(-9, 0));
      float position[3];
      for (int axis = 0; axis < 3; ++axis) {
        position[axis] = static_cast<float>(frame.camera.position.a[axis] -
                                            frame.components[0].particles.origin.a[axis] +
                                            reach * scene.between(-1, 1));
      }
      const ExactDepth exact = exact_depth(position, frame);
      const long double distance =
          std::sqrt(decoded(depth_of(position, scale).key, 2 * scale.finest_unit));
      const double bound =
          std::ldexp(static_cast<double>(exact.distance), -40) + std::ldexp(size, -48);
      EXPECT_NEAR(static_cast<double>(distance - exact.distance), 0, bound) << size;
    }
  }
}

TEST(DepthKey, GrowsFromOneFloatToTheNext) {
  for (const Projection projection :
       {Projection::perspective, Projection::orthographic, Projection::fisheye}) {
    Frame frame = frame_of(10, 10, {component_of({}, one_color(1, 1, 1))});
    frame.projection = projection;
    frame.camera.look_at_distance = 100;
    const DepthKeyScale scale = make_depth_key_scale(frame, frame.components[0]);
    float z = 1e-6f;
    for (int i = 0; i < 3000; ++i) {
      const float above = std::nextafter(z, 1e30f);
      const float before[3] = {0, 0, z}, behind[3] = {0, 0, above};
      ASSERT_LT(depth_of(before, scale).key, depth_of(behind, scale).key) << z;
      z = above * 1.02f;
    }
  }
}

// Of what lies along the view direction, in front of an orthographic camera and behind it.
TEST(DepthKey, IsOrderedThroughZero) {
  Frame frame = frame_of(10, 10, {component_of({}, one_color(1, 1, 1))});
  const DepthKeyScale scale = make_depth_key_scale(frame, frame.components[0]);
  constexpr float largest = std::numeric_limits<float>::max();
  std::uint64_t last = 0;
  for (const float z : {-largest, -1e30f, -2.0f, -1.0f, -1e-12f, 0.0f, 1e-12f, 1.0f, 2.0f, 1e30f}) {
    const float position[3] = {0, 0, z};
    const std::uint64_t key = depth_of(position, scale).key;
    EXPECT_GT(key, last) << z;
    EXPECT_LT(key, std::uint64_t{1} << depth_key_bits);
    last = key;
  }
}

TEST(DepthKey, TakesTheOriginExactly) {
  for (const Projection projection : {Projection::perspective, Projection::fisheye}) {
    // 1e9 and 1e-7 have no sum in double precision.
    Frame frame = frame_of(10, 10, {component_of({}, one_color(1, 1, 1))});
    frame.projection = projection;
    frame.camera.position = {{0, 0, -1e-7}};
    frame.camera.look_at_distance = 1e3;
    frame.components[0].particles.origin = {{0, 0, 1e9}};
    const DepthKeyScale scale = make_depth_key_scale(frame, frame.components[0]);
    const float back[3] = {0, 0, -1e9f};
    const double cell = std::ldexp(1.0, scale.unit + 2);
    const std::uint64_t key = depth_of(back, scale).key;
    const long double depth = projection == Projection::perspective
                                  ? decoded(key - zero_depth, scale.finest_unit)
                                  : std::sqrt(decoded(key, 2 * scale.finest_unit));
    EXPECT_NEAR(static_cast<double>(depth), 1e-7, cell);
  }
}

TEST(DepthLimits, AreDepthsOfParticles) {
  for (const Projection projection :
       {Projection::perspective, Projection::orthographic, Projection::fisheye}) {
    for (const float limit : {1e-5f, 0.1f, 3.0f, 12345.678f}) {
      Frame frame = frame_of(10, 10, {component_of({}, one_color(1, 1, 1))});
      frame.projection = projection;
      frame.near_limit = frame.far_limit = static_cast<double>(limit);
      const DepthKeyScale scale = make_depth_key_scale(frame, frame.components[0]);
      const float at[3] = {0, 0, limit};
      const float before[3] = {0, 0, std::nextafter(limit, 0.0f)};
      const float behind[3] = {0, 0, std::nextafter(limit, 1e30f)};
      EXPECT_TRUE(is_within_limits(depth_of(at, scale), 1, scale)) << limit;
      EXPECT_FALSE(is_within_limits(depth_of(before, scale), 1, scale)) << limit;
      EXPECT_FALSE(is_within_limits(depth_of(behind, scale), 1, scale)) << limit;
    }
  }
}

}  // namespace
}  // namespace splotchcl::test
