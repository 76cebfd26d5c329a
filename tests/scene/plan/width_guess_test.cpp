// How many splats could be stencils, from some of the particles, and what the plan makes of it.
#include "scene/plan/width_guess.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "reference/frames.h"
#include "splotchcl/plan.h"

namespace splotchcl::test {
namespace {

constexpr int side = 64;

// So many clouds for each pixel of a picture, of this sigma, in its middle.
Frame clouds(double per_pixel, double sigma) {
  std::vector<Cloud> clouds(static_cast<std::size_t>(per_pixel * side * side));
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    clouds[i].x = static_cast<double>(i % 10) - 5;
    clouds[i].y = static_cast<double>(i / 10 % 10) - 5;
    clouds[i].sigma = sigma;
    clouds[i].column = 1e-4;
  }
  return frame_of(side, side, {component_of(clouds, one_color(1, 1, 1))});
}

Frame beside_the_picture(Frame frame) {
  std::vector<float> positions;
  const std::size_t count = frame.components.front().particles.count;
  for (std::size_t i = 0; i < count; ++i)
    positions.insert(positions.end(), {10.0F * side, 0, 10});
  frame.components.front().particles.position = Column::owning(positions);
  return frame;
}

TEST(WideSplats, AreThoseOfAnOctaveAndWiderOnes) {
  const WideSplats narrow = guess_wide_splats(clouds(2, 2), 2.2);
  EXPECT_EQ(narrow.of_one_octave, 0);
  EXPECT_EQ(narrow.wider, 0);
  const WideSplats wide = guess_wide_splats(clouds(2, 3), 2.2);
  EXPECT_NEAR(wide.of_one_octave, 2, 0.05);
  EXPECT_EQ(wide.wider, 0);
  const WideSplats wider = guess_wide_splats(clouds(2, 5), 2.2);
  EXPECT_EQ(wider.of_one_octave, 0);
  EXPECT_NEAR(wider.wider, 2, 0.05);
}

TEST(WideSplats, AreThoseOfThePicture) {
  EXPECT_EQ(guess_wide_splats(beside_the_picture(clouds(2, 3)), 2.2).of_one_octave, 0);
}

TEST(WideSplats, AreTheSameForACrop) {
  Frame frame = clouds(2, 3);
  const double whole = guess_wide_splats(frame, 2.2).of_one_octave;
  frame.crop = {50, 50, 8, 8};
  EXPECT_EQ(guess_wide_splats(frame, 2.2).of_one_octave, whole);
}

GridPyramid pyramid_of(const Frame& frame) {
  return make_plan(frame).pyramid;
}

TEST(PlanOfStencils, HasNoneOfFewOrNarrowSplats) {
  EXPECT_FALSE(pyramid_of(clouds(0.05, 6)).has_stencils());
  EXPECT_FALSE(pyramid_of(clouds(2, 2)).has_stencils());
}

TEST(PlanOfStencils, HasThemOnCoarseGrids) {
  const GridPyramid pyramid = pyramid_of(clouds(0.2, 6));
  ASSERT_TRUE(pyramid.has_stencils());
  EXPECT_EQ(pyramid.first_level, 1);
  EXPECT_EQ(pyramid.stencils.size(), 4U);
}

TEST(PlanOfStencils, HasThemOnGridsOfThePicturesPixelsForVeryMany) {
  const GridPyramid pyramid = pyramid_of(clouds(4, 3));
  ASSERT_TRUE(pyramid.has_stencils());
  EXPECT_EQ(pyramid.first_level, 0);
  EXPECT_EQ(pyramid.grids.at(4).level, 0);
  EXPECT_EQ(pyramid.grids.at(5).level, 1);
}

TEST(PlanOfStencils, HasNoneWhereTheyWouldErrByTooMuch) {
  Frame frame = clouds(4, 3);
  frame.tolerance = 1e-4;
  EXPECT_FALSE(pyramid_of(frame).has_stencils());
}

TEST(PlanOfStencils, HasNoneOfCutSplats) {
  Frame frame = clouds(4, 3);
  frame.kernel.cut = 1.8;
  frame.tolerance = 0.1;
  EXPECT_FALSE(pyramid_of(frame).has_stencils());
}

}  // namespace
}  // namespace splotchcl::test
