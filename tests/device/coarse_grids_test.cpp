// The grids of a coarse level share out its widths: their splats are drawn narrower and blurred.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "device/pictures.h"

namespace splotchcl::test {
namespace {

class CoarseGrids : public PictureTest, public testing::WithParamInterface<CompositeShape> {
 protected:
  // More clouds than pixels, of widths from one to another.
  static Frame clouds(double sigma_low, double sigma_high) {
    CloudSetup setup;
    setup.count = 6000;
    setup.width = 80;
    setup.height = 64;
    setup.sigma_low = sigma_low;
    setup.sigma_high = sigma_high;
    setup.column_low = 1e-5;
    setup.column_high = 1e-3;
    return frame_of(setup.width, setup.height, {random_clouds(setup)});
  }

  static double error(const Frame& frame) {
    const Image image = draw(frame, GetParam());
    return largest_difference(image, reference::render(frame).to_float());
  }
};

TEST_P(CoarseGrids, AreFourOfALevelWhereThereAreMoreParticlesThanPixels) {
  Frame frame = clouds(0.5, 30);
  EXPECT_EQ(make_plan(frame).pyramid.blurs.size(), 4U);
  frame.components[0].particles.count = 80 * 64 - 1;
  EXPECT_EQ(make_plan(frame).pyramid.blurs.size(), 2U);
}

TEST_P(CoarseGrids, HoldTheToleranceWithWidthsOfAllOfThem) {
  for (const double tolerance : {1e-3, 1e-4}) {
    Frame frame = clouds(0.5, 30);
    frame.tolerance = tolerance;
    EXPECT_LE(error(frame), tolerance);
  }
}

// The others have no light.
TEST_P(CoarseGrids, HoldTheToleranceWithWidthsOfOneOfThem) {
  const FramePlan plan = make_plan(clouds(0.5, 30));
  const auto narrowest = 2.0 * static_cast<double>(plan.pyramid.coarse_sigma);
  for (int grid = 0; grid < 4; ++grid) {
    SCOPED_TRACE(grid);
    const double sigma = narrowest * std::exp2(0.25 * (grid + 0.1));
    const Frame frame = clouds(sigma, sigma * std::exp2(0.25 * 0.8));
    EXPECT_LE(error(frame), frame.tolerance);
  }
}

TEST_P(CoarseGrids, GiveACropTheBitsOfTheWholePicture) {
  DeviceContext device(choose_device(""));
  Frame frame = clouds(3, 30);
  const Image whole = draw_once(device, frame, GetParam());
  frame.crop = {21, 13, 37, 29};
  EXPECT_EQ(rows_that_differ(draw_once(device, frame, GetParam()), whole, frame.crop), 0);
}

TEST_P(CoarseGrids, DrawFewSplats) {
  for (const double tolerance : {1e-2, 1e-3}) {
    for (unsigned seed = 1; seed <= 100; ++seed) {
      CloudSetup setup;
      setup.seed = seed;
      setup.count = 3;
      setup.width = 160;
      setup.height = 120;
      setup.sigma_low = 2;
      setup.sigma_high = 40;
      setup.column_low = 0.1;
      setup.column_high = 3;
      Frame frame = frame_of(setup.width, setup.height, {random_clouds(setup)});
      frame.tolerance = tolerance;
      EXPECT_LE(error(frame), tolerance) << seed;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, CoarseGrids,
                         testing::Values(CompositeShape::rows, CompositeShape::groups),
                         [](const auto& info) {
                           return std::string(info.param == CompositeShape::rows ? "rows"
                                                                                 : "groups");
                         });

}  // namespace
}  // namespace splotchcl::test
