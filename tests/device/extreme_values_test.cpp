// Columns beyond single precision: stars whose width is next to nothing, and masses of any size.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "device/pictures.h"
#include "scene/particle_rules.h"

namespace splotchcl::test {
namespace {

// A particle of a thousandth of white's light in its pixel, whatever its width.
DrawnComponent star(WeightModel weight, double sigma) {
  const double column = 1e-3 / (pi * sigma * sigma);
  DrawnComponent component = component_of({{0.3, 0.2, 1, sigma, 1}}, one_color(1, 1, 1));
  component.weight = weight;
  component.absorption = {Absorption::Kind::none, 0};
  const double value = column / central_column(weight, 1, sigma, sigma);
  component.particles.weight = Column::owning({static_cast<float>(value)});
  return component;
}

class ExtremeValues : public PictureTest, public testing::WithParamInterface<CompositeShape> {};

TEST_P(ExtremeValues, OfWidthsLeaveAStarItsLight) {
  const std::vector<std::pair<WeightModel, double>> narrowest = {
      {WeightModel::mass, 1e-37}, {WeightModel::constant, 1e-30}, {WeightModel::density, 1e-13}};
  for (const auto& [weight, least] : narrowest) {
    for (const double sigma : {1e-5, 1e-7, 1e-10, 1e-13, 1e-20, 1e-25, 1e-30, 1e-37}) {
      if (sigma < 0.99 * least) continue;
      for (const double tolerance : {1e-3, 1e-5, 0.0}) {
        Frame frame = frame_of(20, 16, {star(weight, sigma)});
        frame.tolerance = tolerance;
        EXPECT_NEAR(sum_of_light(draw(frame, GetParam())), 1e-3, 2e-9)
            << "weight " << static_cast<int>(weight) << ", sigma " << sigma << ", tolerance "
            << tolerance;
      }
    }
  }
}

// A colour of an absorption of its own makes the plan an ordered one.
DrawnComponent giants(bool absorbs, bool is_ordered) {
  std::vector<float> position, h, mass;
  for (const float size : {1e-38f, 1e-30f, 1e-10f, 1e-3f, 1.0f, 1e10f, 1e30f, 3e38f}) {
    for (const float weight : {0.0f, 1e-38f, 1.0f, 1e20f, 3e38f}) {
      position.insert(position.end(), {0.1f, -0.1f, 1});
      h.push_back(size);
      mass.push_back(weight);
    }
  }
  DrawnComponent component;
  component.particles.count = h.size();
  component.particles.position = Column::owning(position);
  component.particles.smoothing_length = Column::owning(h);
  component.particles.weight = Column::owning(mass);
  component.palette = one_color(1, 0.5f, 0);
  if (is_ordered) component.palette.absorption = {Rgb{0.3f, 0.2f, 1}};
  if (!absorbs) component.absorption = {Absorption::Kind::none, 0};
  return component;
}

TEST_P(ExtremeValues, OfMassesAndWidthsMakeNumbersOfAllPixels) {
  for (const double tolerance : {1e-3, 1e-5, 0.0}) {
    for (const auto& [absorbs, is_ordered] :
         {std::pair(false, false), std::pair(true, false), std::pair(true, true)}) {
      Frame frame = frame_of(20, 16, {giants(absorbs, is_ordered)});
      frame.tolerance = tolerance;
      for (const float value : draw(frame, GetParam()).pixels) {
        ASSERT_FALSE(std::isnan(value))
            << "tolerance " << tolerance << ", absorbs " << absorbs << ", ordered " << is_ordered;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, ExtremeValues,
                         testing::Values(CompositeShape::rows, CompositeShape::groups),
                         [](const auto& shape) {
                           return shape.param == CompositeShape::rows ? "Rows" : "Groups";
                         });

}  // namespace
}  // namespace splotchcl::test
