// What a lens and fading with depth do to splats, by the reference renderer.
#include "frames.h"
#include "splotchcl/reference.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

constexpr double focal = 100, focus = 50, aperture = 3;

// On the axis of a perspective camera.
Frame at_depths(const std::vector<double>& depths) {
  std::vector<Cloud> clouds;
  for (const double depth : depths)
    clouds.push_back({0, 0, depth, 0.5, 1});
  Frame frame = frame_of(64, 64, {component_of(clouds, one_color(1, 1, 1))});
  frame.projection = Projection::perspective;
  frame.camera.focal_pixels = focal;
  return frame;
}

double light_of(const reference::Splat& splat) {
  return splat.weight * splat.sigma * splat.sigma;
}

TEST(Lens, WidensByTheCircleOfConfusionAndKeepsTheLight) {
  const std::vector<double> depths = {5, 20, 45, 55, 200, 5000};
  Frame frame = at_depths(depths);
  const auto sharp = reference::project(frame);
  frame.lens = {aperture, focus};
  const auto seen = reference::project(frame);
  ASSERT_EQ(seen.size(), depths.size());
  for (std::size_t i = 0; i < depths.size(); ++i) {
    // Rays through the rim of the lens cross the plane in focus so far apart; in pixels there.
    const double circle = aperture * std::abs(focus - depths[i]) / depths[i] * focal / focus;
    const double disc_variance = circle * circle / 16;
    EXPECT_NEAR(seen[i].sigma * seen[i].sigma, sharp[i].sigma * sharp[i].sigma + 2 * disc_variance,
                1e-9 * circle * circle);
    EXPECT_NEAR(light_of(seen[i]) / light_of(sharp[i]), 1, 1e-12) << "at " << depths[i];
  }
}

TEST(Lens, LeavesAloneWhatIsInFocus) {
  Frame frame = at_depths({focus});
  const auto sharp = reference::project(frame);
  frame.lens = {aperture, focus};
  const auto seen = reference::project(frame);
  EXPECT_NEAR(seen[0].sigma, sharp[0].sigma, 1e-12);
  EXPECT_NEAR(seen[0].weight, sharp[0].weight, 1e-12);
}

std::vector<double> parts_at(const std::vector<double>& depths, Frame frame) {
  const auto all = reference::project(at_depths(depths));
  const auto faded = reference::project(frame);
  std::vector<double> parts;
  for (std::size_t i = 0; i < faded.size(); ++i)
    parts.push_back(faded[i].weight / all[faded[i].particle].weight);
  return parts;
}

TEST(DepthFade, RisesFromTheNearLimitAndFallsToTheFarOne) {
  const std::vector<double> depths = {10, 15, 20, 50, 80, 90, 100};
  Frame frame = at_depths(depths);
  frame.near_limit = 10;
  frame.far_limit = 100;
  frame.fade = {10, 20};
  const std::vector<double> expected = {0, 0.5, 1, 1, 1, 0.5, 0};
  const std::vector<double> parts = parts_at(depths, frame);
  ASSERT_EQ(parts.size(), expected.size());
  for (std::size_t i = 0; i < parts.size(); ++i)
    EXPECT_NEAR(parts[i], expected[i], 1e-12) << "at " << depths[i];
}

TEST(DepthFade, NeverStepsByMoreThanHalfAgainThePartOfItsLength) {
  std::vector<double> depths;
  constexpr double step = 0.05;
  for (double depth = 10 + step; depth < 100; depth += step)
    depths.push_back(depth);
  Frame frame = at_depths(depths);
  frame.near_limit = 10;
  frame.far_limit = 100;
  frame.fade = {10, 20};
  const std::vector<double> parts = parts_at(depths, frame);
  ASSERT_EQ(parts.size(), depths.size());
  EXPECT_LT(parts.front(), 1e-3);
  EXPECT_LT(parts.back(), 1e-3);
  for (std::size_t i = 1; i < parts.size(); ++i)
    ASSERT_LE(std::abs(parts[i] - parts[i - 1]), 1.5001 * step / 10) << "at " << depths[i];
}

}  // namespace
}  // namespace splotchcl::test
