#include "projections/wide_frames.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// The equirectangular picture of 360 degrees against closed forms.

// Longitude to the right, latitude upwards.
Cloud at_place(double longitude, double latitude, double sigma = 0.01, double column = 1) {
  return cloud_towards({{std::cos(latitude) * std::sin(longitude), -std::sin(latitude),
                         std::cos(latitude) * std::cos(longitude)}},
                       3, sigma, column);
}

Frame panorama(const std::vector<Cloud>& clouds, int width = 200) {
  return wide_frame({Projection::equirectangular, width, width / 2}, {white_light(clouds)});
}

// The light of the picture on the sphere: pixels near the poles are narrower there.
double light_on_sphere(const ReferenceImage& image) {
  double sum = 0;
  const double pixel = 2 * pi / image.width;
  for (int y = 0; y < image.height; ++y) {
    const double latitude = 0.5 * pi - (y + 0.5) * pixel;
    for (int x = 0; x < image.width; ++x)
      sum += red_of(image, x, y) * pixel * pixel * std::cos(latitude);
  }
  return sum;
}

TEST(Panorama, PlaceIsLinearInLongitudeAndLatitude) {
  for (const double longitude : {-3.0, -1.0, 0.0, 0.5, 2.0}) {
    for (const double latitude : {-1.4, -0.3, 0.0, 1.2}) {
      const reference::Splat splat = only_splat(panorama({at_place(longitude, latitude)}));
      EXPECT_NEAR(splat.x, 100 + longitude * 100 / pi, 1e-3);
      // The middle of what is round on the sphere lies nearer to the pole, by tan(latitude) / 4 of
      // the width's square.
      const double nearer = 1e-4 * std::tan(latitude) / 4;
      EXPECT_NEAR(splat.y, 50 - (latitude + nearer) * 100 / pi, 1e-3);
    }
  }
}

TEST(Panorama, CloudsWidenTowardsThePoles) {
  for (const double latitude : {0.0, 0.5, -1.0, 1.4}) {
    const reference::Splat splat = only_splat(panorama({at_place(1, latitude)}));
    EXPECT_NEAR(splat.sigma, 0.01 * 100 / pi, 1e-6);
    // Far from the pole, at 17 sigma the nearest, to the square of that.
    EXPECT_NEAR(splat.stretch * std::cos(latitude), 1, std::pow(0.01 / std::cos(latitude), 2));
  }
}

TEST(Panorama, CloudAtThePoleIsARingOfEvenLight) {
  const ReferenceImage image = reference::render(panorama({at_place(1, 0.5 * pi, 0.2)}));
  // The first overtone of the copies' sum is 2 exp(-pi) (docs/projections.md).
  for (int x = 0; x < 200; ++x)
    EXPECT_NEAR(red_of(image, x, 0), 1, 2 * std::exp(-pi) + 0.01);
}

// The rows' lengths are taken for straight, which errs by about the square of the width.
TEST(Panorama, CloudsKeepTheirLightUpToThePole) {
  constexpr double sigma = 0.1;
  for (const double from_pole : {0.0, 0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.5, 1.5}) {
    const ReferenceImage image =
        reference::render(panorama({at_place(0.3, 0.5 * pi - from_pole, sigma)}));
    EXPECT_NEAR(light_on_sphere(image) / (pi * sigma * sigma), 1, 2 * sigma * sigma) << from_pole;
  }
}

// Which pole is nearer to a cloud on the horizon a rounding would decide.
TEST(Panorama, WideCloudOnTheHorizonShowsOverBothPolesAlike) {
  for (const double latitude : {-1e-12, 0.0, 1e-12}) {
    const ReferenceImage image = reference::render(panorama({at_place(0.3, latitude, 1.5)}));
    for (int x = 0; x < 200; ++x)
      EXPECT_NEAR(red_of(image, x, 0), red_of(image, x, 99), 1e-9) << latitude << " " << x;
  }
}

TEST(Panorama, CloudsAreAtMostTwoRadiansWide) {
  EXPECT_NEAR(only_splat(panorama({at_place(0.3, 0, 1.9)})).sigma, 1.9 * 100 / pi, 1e-4);
  for (const double sigma : {2.0, 4.0, 9.0})
    EXPECT_NEAR(only_splat(panorama({at_place(0.3, 0, sigma)})).sigma, 2 * 100 / pi, 1e-4);
}

TEST(Panorama, CloudOnTheSeamIsOnBothSides) {
  const ReferenceImage seam = reference::render(panorama({at_place(pi - 0.004, 0.2, 0.1)}));
  const ReferenceImage middle = reference::render(panorama({at_place(-0.004, 0.2, 0.1)}));
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 200; ++x) {
      EXPECT_NEAR(red_of(seam, x, y), red_of(middle, (x + 100) % 200, y), 1e-4) << x << ", " << y;
    }
  }
}

// Rows of an even sky, and how far each is off the median of all.
std::vector<double> rows_off_median(const ReferenceImage& image) {
  std::vector<double> rows(static_cast<std::size_t>(image.height));
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x)
      rows[static_cast<std::size_t>(y)] += red_of(image, x, y) / image.width;
  }
  std::vector<double> sorted = rows;
  std::sort(sorted.begin(), sorted.end());
  for (double& row : rows)
    row = row / sorted[sorted.size() / 2] - 1;
  return rows;
}

TEST(Panorama, ShowsAnEvenSkyEvenlyUpToThePoles) {
  for (const double width : {0.03, 0.05, 0.1}) {
    const ReferenceImage image = reference::render(
        wide_frame({Projection::equirectangular, 120, 60}, {even_sky(16000, width)}));
    for (const double off : rows_off_median(image))
      EXPECT_NEAR(off, 0, 0.02) << width;
    for (int y = 0; y < 60; ++y) {
      for (int x = 0; x < 120; ++x)
        EXPECT_NEAR(red_of(image, x, y), 1, 0.05) << x << ", " << y;
    }
  }
}

TEST(Panorama, MayShowAPartOfTheSky) {
  const Frame frame =
      wide_frame({Projection::equirectangular, 90, 60, 90.0}, {white_light({at_place(0.5, 0.25)})});
  const reference::Splat splat = only_splat(frame);
  EXPECT_NEAR(splat.x, 45 + 0.5 * 180 / pi, 1e-3);
  EXPECT_NEAR(splat.y, 30 - 0.25 * 180 / pi, 1e-3);
}

TEST(Panorama, IsAtMost180DegreesHigh) {
  EXPECT_THROW(wide_frame({Projection::equirectangular, 100, 60}, {}), UsageError);
  EXPECT_NO_THROW(wide_frame({Projection::equirectangular, 100, 30}, {}));
}

// The fisheye picture of a dome against closed forms.

constexpr double degree = pi / 180;

// Where the camera sees a point at this angle from its view direction, turned by `around`.
Cloud at_angle(double angle, double around, double distance = 3) {
  return cloud_towards(
      {{std::sin(angle) * std::cos(around), std::sin(angle) * std::sin(around), std::cos(angle)}},
      distance, 0.01);
}

// All directions lead there; those of its digits are roundings.
TEST(Dome, PutsWhatIsRightBehindTheCameraToTheRight) {
  const WideCamera camera = {Projection::fisheye, 300, 200, 360};
  for (const double around : {0.0, 0.7, 3.0}) {
    const reference::Splat splat =
        only_splat(wide_frame(camera, {white_light({at_angle(180 * degree, around)})}));
    EXPECT_NEAR(splat.x, 250, 1e-9);
    EXPECT_NEAR(splat.y, 100, 1e-9);
  }
}

TEST(Dome, RadiusIsLinearInTheAngle) {
  for (const double field_of_view : {60.0, 180.0, 240.0, 360.0}) {
    const WideCamera camera = {Projection::fisheye, 300, 200, field_of_view};
    for (const double part : {0.0, 0.1, 0.5, 0.9, 1.0}) {
      if (field_of_view * part == 360) continue;  // right behind the camera
      const double angle = part * 0.5 * field_of_view * degree;
      const reference::Splat splat =
          only_splat(wide_frame(camera, {white_light({at_angle(angle, 0.7)})}));
      // Positions are stored in single precision.
      EXPECT_NEAR(splat.x, 150 + 100 * part * std::cos(0.7), 1e-3);
      EXPECT_NEAR(splat.y, 100 + 100 * part * std::sin(0.7), 1e-3);
    }
  }
}

TEST(Dome, DepthIsTheDistance) {
  const Frame frame = wide_frame({}, {white_light({at_angle(1.5, 0, 5), at_angle(0, 0, 6)})});
  const auto splats = reference::project(frame);
  ASSERT_EQ(splats.size(), 2u);
  EXPECT_LT(splats[0].key, splats[1].key) << "the nearer one, though its z is larger";
}

TEST(Dome, LimitsAreDistances) {
  Frame frame = wide_frame({}, {white_light({at_angle(1.5, 0, 5), at_angle(2.5, 0, 7)})});
  frame.near_limit = 4;
  frame.far_limit = 6;
  EXPECT_EQ(reference::project(frame).size(), 1u);
}

TEST(Dome, IsDarkOutsideItsCircle) {
  Frame frame = wide_frame({Projection::fisheye, 90, 60, 180.0}, {even_sky(500, 0.1)});
  frame.background = {0.5, 0.5, 0.5};
  const ReferenceImage image = reference::render(frame);
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 90; ++x) {
      const bool inside = std::hypot(x + 0.5 - 45, y + 0.5 - 30) <= 30;
      EXPECT_EQ(red_of(image, x, y) > 0, inside) << x << ", " << y;
    }
  }
}

// Within what neighbouring clouds leave uneven, and what flat splats on a curved sky err.
TEST(Dome, ShowsAnEvenSkyEvenly) {
  const ReferenceImage image =
      reference::render(wide_frame({Projection::fisheye, 60, 60, 220.0}, {even_sky(8000, 0.05)}));
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 60; ++x) {
      const double radius = std::hypot(x + 0.5 - 30, y + 0.5 - 30);
      if (radius >= 30) continue;
      EXPECT_NEAR(red_of(image, x, y), 1, 0.03) << x << ", " << y;
    }
  }
}

TEST(Dome, TakesAnyAngleUpTo360Degrees) {
  for (const double bad : {0.0, -10.0, 361.0, std::nan("")}) {
    EXPECT_THROW(wide_frame({Projection::fisheye, 10, 10, bad}, {}), UsageError) << bad;
  }
  EXPECT_NO_THROW(wide_frame({Projection::fisheye, 10, 10, 360.0}, {}));
}

}  // namespace
}  // namespace splotchcl::test
