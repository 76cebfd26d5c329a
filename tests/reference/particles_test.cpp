#include "frames.h"
#include "reference/depth_key.h"
#include "reference/frames.h"
#include "scene/particle_rules.h"
#include "splotchcl/reference.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

using reference::Depth;
using reference::depth_of;
using reference::is_within_limits;

// The host's rules for particles beside the reference renderer's own copy of them.

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
constexpr float infinite = std::numeric_limits<float>::infinity();

// One particle with every column that a particle can have.
DrawnComponent full_particle() {
  DrawnComponent component = component_of({{}}, one_color(1, 1, 1));
  component.particles.color = Column::owning({0.5F});
  component.particles.color_vector = Column::owning({1, 0, 0.5F});
  component.particles.intensity = Column::owning({1});
  component.particles.sort_field = Column::owning({-3});
  return component;
}

void expect_bad(const DrawnComponent& component, bool bad) {
  EXPECT_EQ(is_bad(component.particles, 0), bad);
  const Frame frame = frame_of(4, 4, {component});
  EXPECT_EQ(reference::count_bad(frame), bad ? 1U : 0U);
}

std::vector<Column Particles::*> columns() {
  return {&Particles::position,  &Particles::smoothing_length, &Particles::weight,
          &Particles::color,     &Particles::color_vector,     &Particles::intensity,
          &Particles::sort_field};
}

TEST(BadParticles, AreTheOracles) {
  expect_bad(full_particle(), false);
  for (Column Particles::*const column : columns()) {
    const Column good = full_particle().particles.*column;
    for (std::size_t value = 0; value < good.size(); ++value) {
      for (const float wrong : {not_a_number, infinite, -infinite}) {
        DrawnComponent component = full_particle();
        std::vector<float> values(good.data(), good.data() + good.size());
        values[value] = wrong;
        component.particles.*column = Column::owning(values);
        expect_bad(component, true);
      }
    }
  }
}

TEST(BadParticles, HaveLengthsWeightsOrColorsBelowTheirRange) {
  DrawnComponent component = full_particle();
  component.particles.smoothing_length = Column::owning({0});
  expect_bad(component, true);
  component.particles.smoothing_length = Column::owning({-1});
  expect_bad(component, true);
  component = full_particle();
  component.particles.weight = Column::owning({-1});
  expect_bad(component, true);
  component = full_particle();
  component.particles.color_vector = Column::owning({1, 1, -0.25F});
  expect_bad(component, true);
}

TEST(BadParticles, NeedNoMoreThanPositionAndLength) {
  Particles particles = full_particle().particles;
  for (Column Particles::*const column : columns()) {
    if (column == &Particles::position || column == &Particles::smoothing_length) continue;
    particles.*column = Column();
  }
  EXPECT_FALSE(is_bad(particles, 0));
}

// Depth 1 and h 1 and above: where the limit follows from h, 10 h is too near.
TEST(Limits, AreTheOracles) {
  for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
    for (const double h : {1.0, 9.9, 10.1}) {
      for (const std::optional<double> near : {std::optional<double>(), {0.5}, {1.5}}) {
        for (const std::optional<double> far : {std::optional<double>(), {0.9}, {1.1}}) {
          Frame frame = frame_of(4, 4, {component_of({{0, 0, 1, h}}, one_color(1, 1, 1))});
          frame.projection = projection;
          frame.near_limit = near;
          frame.far_limit = far;
          EXPECT_EQ(is_within_limits(frame, 1, h), reference::project(frame).size() == 1)
              << "h " << h << ", near " << near.value_or(-1) << ", far " << far.value_or(-1);
        }
      }
    }
  }
}

TEST(Weights, AreTheOraclesWithEveryModelAndUnit) {
  for (const WeightModel model : {WeightModel::mass, WeightModel::density, WeightModel::constant}) {
    for (const double unit : {1e-20, 1.0, 3e24}) {
      Frame frame = frame_of(4, 4, {component_of({{0, 0, 1, 2}}, one_color(1, 1, 1))});
      frame.kernel.width = 0.4;
      frame.camera.look_at_distance = unit;
      DrawnComponent& component = frame.components[0];
      component.weight = model;
      component.reference_column = 7;
      const double value = static_cast<double>(component.particles.weight[0]);
      const double h = 2, sigma = 0.4 * h;
      const double expected = reference::project(frame).at(0).weight;
      EXPECT_NEAR(central_column(model, value, h, sigma) / 7, expected, 1e-14 * expected);
      const double scale = length_scale(frame), a = weight_scale(component, scale);
      const double scaled = model == WeightModel::mass ? value * a * a / std::pow(scale * sigma, 2)
                            : model == WeightModel::density ? value * a * (scale * sigma)
                                                            : value * a / (scale * h);
      EXPECT_NEAR(scaled, expected, 1e-14 * expected);
    }
  }
}

TEST(ParticleCount, IsOfAllComponents) {
  EXPECT_EQ(particle_count(frame_of(1, 1, {})), 0U);
  EXPECT_EQ(particle_count(frame_of(1, 1, {full_particle(), full_particle(), full_particle()})),
            3U);
}

// Keys and the order they give.

std::vector<std::uint64_t> sorted(const std::vector<std::uint64_t>& keys, const SortOrder& order) {
  std::vector<reference::Splat> splats(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    splats[i].key = keys[i];
    splats[i].particle = i;
  }
  reference::sort(splats, order);
  std::vector<std::uint64_t> particles;
  for (const auto& splat : splats)
    particles.push_back(splat.particle);
  return particles;
}

SortOrder by_field(bool descending) {
  SortOrder order;
  order.by = SortOrder::By::field;
  order.field = "density";
  order.descending = descending;
  return order;
}

TEST(Sort, PutsTheSmallestKeyInFront) {
  EXPECT_EQ(sorted({3, 1, 2}, {}), (std::vector<std::uint64_t>{1, 2, 0}));
  EXPECT_EQ(sorted({3, 1, 2}, by_field(false)), (std::vector<std::uint64_t>{1, 2, 0}));
}

TEST(Sort, PutsTheLargestKeyInFrontWhenDescending) {
  EXPECT_EQ(sorted({3, 1, 2}, by_field(true)), (std::vector<std::uint64_t>{0, 2, 1}));
}

TEST(Sort, KeepsEqualKeysInFileOrder) {
  EXPECT_EQ(sorted({1, 0, 1, 0, 1}, {}), (std::vector<std::uint64_t>{1, 3, 0, 2, 4}));
  EXPECT_EQ(sorted({1, 0, 1, 0, 1}, by_field(true)), (std::vector<std::uint64_t>{0, 2, 4, 1, 3}));
}

TEST(Key, OfAFieldHasTheOrderOfItsValues) {
  constexpr float smallest = std::numeric_limits<float>::denorm_min();
  constexpr float largest = std::numeric_limits<float>::max();
  const std::vector<float> values = {-largest, -3,       -1, -smallest, -0.0f,
                                     0.0f,     smallest, 1,  largest};
  Frame frame =
      frame_of(8, 8, {component_of(std::vector<Cloud>(values.size()), one_color(1, 1, 1))});
  frame.sort = by_field(false);
  frame.components[0].particles.sort_field = Column::owning(values);
  const auto splats = reference::project(frame);
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (values[i] == 0 && values[i - 1] == 0) {
      EXPECT_EQ(splats[i - 1].key, splats[i].key) << "-0 is 0";
    } else {
      EXPECT_LT(splats[i - 1].key, splats[i].key) << values[i];
    }
  }
}

TEST(Render, SortsByAFieldInsteadOfDepthWhenTheSceneSaysSo) {
  // The far cloud has the smaller field: it covers the near one.
  DrawnComponent opaque =
      component_of({Cloud{0.5, 0.5, 1, 9, 50}, Cloud{0.5, 0.5, 2, 9, 50}}, one_color(1, 1, 1));
  opaque.palette.emission = {Rgb{1, 0, 0}, Rgb{0, 1, 0}};
  opaque.palette.absorption = {Rgb{1, 1, 1}, Rgb{1, 1, 1}};
  opaque.particles.color = Column::owning({0, 1});
  opaque.particles.sort_field = Column::owning({2, 1});
  Frame frame = frame_of(16, 16, {opaque});
  frame.sort = by_field(false);
  const ReferenceImage image = reference::render(frame);
  const double* middle = &image.pixels[4 * (8 * 16 + 8)];
  EXPECT_LT(middle[0], 1e-6);
  EXPECT_GT(middle[1], 0.01);
}

// The keys of depths beside depths in higher precision.

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
