// What the reference renderer draws of clouds around the camera, in closed forms.
#include "projections/wide_frames.h"
#include "scene/projection.h"
#include "splotchcl/reference.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

constexpr Projection projections[] = {Projection::perspective, Projection::fisheye,
                                      Projection::equirectangular, Projection::cube};

// A camera at the origin that looks along +z.
Frame frame_through(Projection projection, const std::vector<Cloud>& clouds) {
  WideCamera camera;
  camera.projection = projection;
  camera.width = 24;
  camera.height = projection == Projection::equirectangular ? 12 : 24;
  Frame frame = wide_frame(camera, {white_light(clouds)});
  frame.through_clouds = true;
  return frame;
}

double light_in(const Frame& frame, int x, int y) {
  return red_of(reference::render(frame), x, y);
}

Vec3 direction_of(const Frame& frame, int x, int y) {
  return direction_at(x + 0.5, y + 0.5, frame.camera, frame.projection);
}

// exp(-r^2) / sqrt(pi), which has the column 1 through its center, along a ray from the camera.
double integrated(const Vec3& center, const Vec3& direction) {
  constexpr double end = 40, step = 1e-3;
  double sum = 0;
  for (double s = 0.5 * step; s < end; s += step) {
    double squared = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double d = s * direction.a[axis] - center.a[axis];
      squared += d * d;
    }
    sum += std::exp(-squared);
  }
  return sum * step / std::sqrt(pi);
}

TEST(RayShape, IsTheIntegralAlongTheRay) {
  const double size = std::sqrt(0.04 + 0.09 + 0.87);
  const Vec3 direction = {{0.2 / size, -0.3 / size, std::sqrt(0.87) / size}};
  for (const Vec3& center : {Vec3{{0, 0, 0}}, Vec3{{0.5, 1, 3}}, Vec3{{-1, 0.3, -0.7}},
                             Vec3{{2, -1, 11}}, Vec3{{0.1, 0.2, -2}}}) {
    EXPECT_NEAR(reference::ray_shape(center, direction), integrated(center, direction), 1e-7);
  }
}

TEST(CloudsAround, ShowHalfOfTheirColumnInEveryDirectionFromTheirCenter) {
  for (const Projection projection : projections) {
    const Frame frame = frame_through(projection, {{0, 0, 0, 2, 0.8}});
    const ReferenceImage image = reference::render(frame);
    for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
      if (image.pixels[i] == 0 && projection == Projection::fisheye) continue;  // beside its circle
      EXPECT_NEAR(image.pixels[i], 0.4, 1e-7);
    }
    EXPECT_NEAR(red_of(image, 12, 6), 0.4, 1e-7);
  }
}

// t sigma before the camera, and t sigma behind it for t < 0.
TEST(CloudsAround, FadeAsTheErrorFunctionWhenTheyPassTheCamera) {
  for (const double t : {3.0, 1.0, 0.3, -0.3, -1.0, -2.0}) {
    Frame frame = frame_through(Projection::perspective, {{0, 0, 5 * t, 5, 1}});
    frame.camera.center_x += 0.5;  // a pixel's center looks straight ahead
    frame.camera.center_y += 0.5;
    EXPECT_NEAR(light_in(frame, 12, 12), 0.5 * std::erfc(-t), 1e-7) << t;
  }
}

TEST(CloudsAround, AreWhatEachRayFindsUpToFourSigma) {
  for (const Projection projection : projections) {
    const Frame frame = frame_through(projection, {{1, -2, 3, 1, 1}, {-4, 1, -2, 2, 0.7}});
    for (const int x : {3, 11, 20}) {
      for (const int y : {4, 7}) {
        const Vec3 direction = direction_of(frame, x, y);
        const double expected =
            integrated({{1, -2, 3}}, direction) + 0.7 * integrated({{-2, 0.5, -1}}, direction);
        EXPECT_NEAR(light_in(frame, x, y), expected, 1e-7);
      }
    }
  }
}

TEST(CloudsAround, AreSplatsLikeOthersFromTwelveSigmaOn) {
  for (const Projection projection : projections) {
    Frame frame = frame_through(projection, {{1, -2, 12, 1, 1}});
    const ReferenceImage through = reference::render(frame);
    frame.through_clouds = false;
    EXPECT_EQ(through.pixels, reference::render(frame).pixels);
  }
}

TEST(CloudsAround, AreHalfOfBothAtEightSigma) {
  Frame frame = frame_through(Projection::perspective, {{0, 0, 8, 1, 1}});
  const double both = light_in(frame, 13, 14);
  const double ray = integrated({{0, 0, 8}}, direction_of(frame, 13, 14));
  frame.through_clouds = false;
  EXPECT_NEAR(both, 0.5 * ray + 0.5 * light_in(frame, 13, 14), 1e-7);
}

TEST(CloudsAround, KeepTheNearLimitThatIsSet) {
  Frame frame = frame_through(Projection::perspective, {{0, 0, 1, 5, 1}, {0, 0, -1, 5, 1}});
  frame.near_limit = 2;
  EXPECT_EQ(light_in(frame, 12, 12), 0);
  frame.near_limit = 0;
  EXPECT_EQ(reference::project(frame).size(), 1u);
}

TEST(CloudsAround, LieInFrontWhereTheirCentersAreBehindTheCamera) {
  DrawnComponent blue = component_of({{0, 0, -0.5, 1, 1}}, one_color(0, 0, 1));
  DrawnComponent red = component_of({{0, 0, 0.5, 1, 1}}, one_color(1, 0, 0));
  blue.absorption = red.absorption = {Absorption::Kind::as_emission, 0};
  Frame frame = frame_through(Projection::perspective, {});
  frame.components = {red, blue};
  std::vector<reference::Splat> splats = reference::project(frame);
  reference::sort(splats, frame.sort);
  ASSERT_EQ(splats.size(), 2u);
  EXPECT_EQ(splats[0].particle, 1u);
}

TEST(CloudsAround, AreNothingToAnOrthographicCamera) {
  Frame frame = frame_of(8, 8, {white_light({{0, 0, 1, 3, 1}, {0, 0, -1, 3, 1}})});
  const ReferenceImage as_ever = reference::render(frame);
  frame.through_clouds = true;
  EXPECT_EQ(reference::render(frame).pixels, as_ever.pixels);
}

TEST(DirectionAt, IsWhereProjectPointTakesIt) {
  for (const Projection projection : projections) {
    const Frame frame = frame_through(projection, {});
    for (const Vec3& point : {Vec3{{1, 2, 7}}, Vec3{{-3, 0.5, 4}}, Vec3{{0.1, -2, 2.5}}}) {
      const auto place = project_point(point, frame.camera, projection);
      ASSERT_TRUE(place);
      const Vec3 direction = direction_at(place->x, place->y, frame.camera, projection);
      const double size = std::hypot(point.a[0], point.a[1], point.a[2]);
      for (std::size_t axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(direction.a[axis], point.a[axis] / size, 1e-12);
    }
  }
}

}  // namespace
}  // namespace splotchcl::test
