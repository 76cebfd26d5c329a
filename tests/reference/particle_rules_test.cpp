// The host's rules for particles beside the reference renderer's own copy of them.
#include "scene/particle_rules.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "frames.h"
#include "splotchcl/reference.h"

namespace splotchcl::test {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

// One particle with every column that a particle can have.
DrawnComponent one_particle() {
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
  expect_bad(one_particle(), false);
  for (Column Particles::*const column : columns()) {
    const Column good = one_particle().particles.*column;
    for (std::size_t value = 0; value < good.size(); ++value) {
      for (const float wrong : {nan, infinity, -infinity}) {
        DrawnComponent component = one_particle();
        std::vector<float> values(good.data(), good.data() + good.size());
        values[value] = wrong;
        component.particles.*column = Column::owning(values);
        expect_bad(component, true);
      }
    }
  }
}

TEST(BadParticles, HaveLengthsWeightsOrColorsBelowTheirRange) {
  DrawnComponent component = one_particle();
  component.particles.smoothing_length = Column::owning({0});
  expect_bad(component, true);
  component.particles.smoothing_length = Column::owning({-1});
  expect_bad(component, true);
  component = one_particle();
  component.particles.weight = Column::owning({-1});
  expect_bad(component, true);
  component = one_particle();
  component.particles.color_vector = Column::owning({1, 1, -0.25F});
  expect_bad(component, true);
}

TEST(BadParticles, NeedNoMoreThanPositionAndLength) {
  Particles particles = one_particle().particles;
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
  EXPECT_EQ(particle_count(frame_of(1, 1, {one_particle(), one_particle(), one_particle()})), 3U);
}

}  // namespace
}  // namespace splotchcl::test
