#include "certificate/color_errors.h"

#include <gtest/gtest.h>

#include <limits>

#include "reference/frames.h"

namespace splotchcl::test {
namespace {

// A star of some color among these knots, and the range of its field.
Frame star_among(const std::vector<Rgb>& knots, const ScalarMap& range) {
  DrawnComponent component = component_of({{0, 0, 1, 3, 1}}, {"some colors", knots, {}});
  component.particles.color = Column::uniform(1);
  component.color = range;
  component.absorption = {Absorption::Kind::none, 0};
  return frame_of(10, 10, {component});
}

double of_brightest(const Frame& frame, const FramePlan& plan) {
  return parts_of_colors(frame, plan).of_brightest;
}

FramePlan certified(const Frame& frame) {
  PlanOptions options;
  options.certify = true;
  return make_plan(frame, options);
}

double part_of_range(Scaling scaling, double minimum, double maximum) {
  const Frame frame = star_among({{1, 0, 0}, {0, 0, 1}}, {scaling, minimum, maximum});
  return of_brightest(frame, certified(frame));
}

double part_of_knots(const std::vector<Rgb>& knots) {
  const Frame frame = star_among(knots, {Scaling::linear, 0, 1});
  return of_brightest(frame, certified(frame));
}

TEST(ColorErrors, DoNotFollowTheRange) {
  EXPECT_EQ(part_of_range(Scaling::linear, 0, 1), part_of_range(Scaling::linear, 1e6, 1e6 + 1));
  EXPECT_EQ(part_of_range(Scaling::log, 1, 6), part_of_range(Scaling::log, 5.995, 6));
  EXPECT_EQ(part_of_range(Scaling::asinh, -1, 20), part_of_range(Scaling::asinh, 20, 20.01));
  EXPECT_LT(part_of_range(Scaling::log, 1, 6), 6e-6);
}

TEST(ColorErrors, GrowAsTheRangeBecomesNarrowBesideLogarithmsOfWhatFloatsHardlyHold) {
  EXPECT_GT(part_of_range(Scaling::log, -39, -38.995), 500 * part_of_range(Scaling::log, -39, -34));
}

TEST(ColorErrors, GrowWithTheNumberOfTimesThatColorsChange) {
  const Rgb red = {1, 0, 0}, blue = {0, 0, 1};
  EXPECT_NEAR(part_of_knots({red, blue, red, blue, red}), 4 * part_of_knots({red, blue}), 1e-12);
  EXPECT_LT(part_of_knots({red, {1, 0, 0.1f}}), 0.2 * part_of_knots({red, blue}));
}

TEST(ColorErrors, OfAFastPictureAreLessThanItsBoundAndMoreThanOfAnExtendedOne) {
  const Frame frame = star_among({{1, 0, 0}, {0, 0, 1}}, {Scaling::log, 1, 8});
  const FramePlan plan = make_plan(frame);
  const double part = of_brightest(frame, plan);
  EXPECT_LT(part, of_brightest(frame, certified(frame)));
  EXPECT_GT(part, 1000 * of_brightest(frame, extend_plan(frame, plan)));
}

TEST(ColorErrors, AreThoseOfTheChannelItselfWhereItIsNeverDark) {
  const auto of_itself = [](const std::vector<Rgb>& knots) {
    const Frame frame = star_among(knots, {Scaling::linear, 0, 1});
    return parts_of_colors(frame, make_plan(frame)).of_itself;
  };
  EXPECT_LT(of_itself({{1, 0.5f, 0.1f}, {0.5f, 1, 0.2f}}), 1e-6);
  EXPECT_LT(of_itself({{0, 0, 0}, {0.5f, 1, 0.2f}}), 1e-6) << "it grows from nothing";
  EXPECT_EQ(of_itself({{1, 0, 0}, {0, 0, 1}}), std::numeric_limits<double>::infinity());
}

TEST(ColorErrors, CountByTheBrightestChannelWhereItIsFaintest) {
  const double halfway = part_of_knots({{1, 0, 0}, {0, 0, 1}});
  EXPECT_NEAR(part_of_knots({{1, 0, 0}, {1, 0, 1}}), 0.5 * halfway, 1e-12);
  EXPECT_NEAR(part_of_knots({{0, 0, 0}, {0, 0, 1}}), halfway, 1e-12);
}

TEST(ColorErrors, AreNoneOfAPaletteOfOneColor) {
  EXPECT_EQ(part_of_knots({{1, 0.5f, 0}}), 0);
  EXPECT_EQ(part_of_knots({{1, 0.5f, 0}, {1, 0.5f, 0}}), 0);
}

}  // namespace
}  // namespace splotchcl::test
