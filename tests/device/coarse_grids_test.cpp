// The grids of a level share out its widths: their splats are drawn narrower, or as stencils, and
// blurred.
#include "device/pictures.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

class CoarseGrids : public PictureTest, public testing::WithParamInterface<CompositeShape> {
 protected:
  // More clouds than pixels, of widths from one to another.
  static Frame clouds(double sigma_low, double sigma_high, int count = 6000) {
    CloudSetup setup;
    setup.count = count;
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
  frame.tolerance = 1e-4;  // too small for stencils, which take four of any number
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

// They are narrower Gaussians, which have to be wider than the blur (GridPyramid::wider_for).
TEST_P(CoarseGrids, HoldTheToleranceWithSplatsTooBrightForStencils) {
  for (std::uint64_t seed = 10; seed <= 13; ++seed) {
    CloudSetup bright;
    bright.seed = seed;
    bright.count = 20;
    bright.width = 160;
    bright.height = 128;
    bright.sigma_low = 4.4;
    bright.sigma_high = 17;
    bright.column_low = 0.5;
    bright.column_high = 3;
    CloudSetup faint = bright;
    faint.count = 4000;
    faint.column_low = faint.column_high = 1e-5;
    Frame frame =
        frame_of(bright.width, bright.height, {random_clouds(bright), random_clouds(faint)});
    frame.tolerance = 1e-2;
    ASSERT_TRUE(make_plan(frame).pyramid.has_stencils());
    EXPECT_LE(error(frame), frame.tolerance) << seed;
  }
}

// Their guard bands, which refining and blurring read, reach farther beside the picture.
TEST_P(CoarseGrids, LeaveOutSplatsThatShowNowhereInThePicture) {
  constexpr int width = 640, height = 480;
  constexpr double sigma = 12;
  const auto drawn_with_distance_beside_picture = [](double distance, double column) {
    const Cloud cloud = {-0.5 * width - distance, 0, 10, sigma, column};
    DeviceContext device(choose_device(""));
    device.traits.choose_shape(GetParam() == CompositeShape::rows);
    const Frame frame = frame_of(width, height, {component_of({cloud}, two_colors())});
    return draw_with_plan(device, frame, make_plan(frame)).counts.visible;
  };
  EXPECT_EQ(drawn_with_distance_beside_picture(2 * sigma, 0.5), 1U);
  EXPECT_EQ(drawn_with_distance_beside_picture(4.7 * sigma, 0.5), 0U);
  EXPECT_EQ(drawn_with_distance_beside_picture(4.7 * sigma, 100), 1U) << "a bright one";
}

// So many splats that need the picture's own pixels that some of its grids have them.
class GridsOfOwnPixels : public CoarseGrids {
 protected:
  static Frame many_clouds() {
    const Frame frame = clouds(2.2, 4.4, 26000);
    EXPECT_EQ(make_plan(frame).pyramid.first_level, 0);
    return frame;
  }
};

TEST_P(GridsOfOwnPixels, HoldTheTolerance) {
  const Frame frame = many_clouds();
  EXPECT_LE(error(frame), frame.tolerance);
}

TEST_P(GridsOfOwnPixels, GiveACropTheBitsOfTheWholePicture) {
  DeviceContext device(choose_device(""));
  Frame frame = many_clouds();
  const Image whole = draw_once(device, frame, GetParam());
  frame.crop = {21, 9, 37, 23};
  EXPECT_EQ(rows_that_differ(draw_once(device, frame, GetParam()), whole, frame.crop), 0);
}

const auto name_of_shape = [](const auto& info) {
  return std::string(info.param == CompositeShape::rows ? "rows" : "groups");
};

INSTANTIATE_TEST_SUITE_P(Shapes, CoarseGrids,
                         testing::Values(CompositeShape::rows, CompositeShape::groups),
                         name_of_shape);
INSTANTIATE_TEST_SUITE_P(Shapes, GridsOfOwnPixels,
                         testing::Values(CompositeShape::rows, CompositeShape::groups),
                         name_of_shape);

}  // namespace
}  // namespace splotchcl::test
