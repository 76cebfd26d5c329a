// Centres, widths, weights and colours of the stage `project` against the oracle's, within
// bounds that follow from the roundings of its operations in single precision.
#include "device/stages.h"
#include "scene/particle_rules.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

constexpr double unit = 0x1p-24;  // the relative error of one rounding

// Clouds in a ball around `centre`, of widths from far below to far above a pixel when the
// ball fills a picture of some hundred pixels.
DrawnComponent ball(const Vec3& center, double radius, const Vec3& origin, std::uint64_t seed) {
  constexpr std::size_t count = 2003;
  Random random(seed);
  std::vector<float> positions, sizes, weights;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double place = center.a[axis] + radius * random.uniform(-0.55, 0.55);
      positions.push_back(static_cast<float>(place - origin.a[axis]));
    }
    const double sigma = radius * random.logarithmic(1e-5, 0.3);
    sizes.push_back(static_cast<float>(sigma));
    weights.push_back(static_cast<float>(random.logarithmic(0.1, 1) * pi * sigma * sigma));
  }
  DrawnComponent component;
  component.particles.count = count;
  component.particles.origin = origin;
  component.particles.position = Column::owning(positions);
  component.particles.smoothing_length = Column::owning(sizes);
  component.particles.weight = Column::owning(weights);
  return component;
}

// The camera stands where a ball around the centre fills its field of view.
Frame seen(const Vec3& center, double radius, double field_of_view, const Vec3& origin,
           std::uint64_t seed) {
  Camera camera;
  camera.look_at = center;
  const double distance = 1.2 * radius / std::sin(0.5 * field_of_view * pi / 180);
  camera.position = center + Vec3{{0.48, -0.6, 0.64}} * distance;
  camera.sky = {{0.3, 1, 0.2}};
  camera.field_of_view_degrees = field_of_view;
  Frame frame = frame_of(1000, 900, {ball(center, radius, origin, seed)});
  frame.camera = make_camera_frame(camera, frame.width, frame.height);
  frame.projection = Projection::perspective;
  return with_identities(frame);
}

// A splat as the oracle projects it, and what its rounding errors follow from.
struct Expected {
  reference::Splat splat;
  double scale;       // pixels per length at the splat's depth
  double distance;    // from the camera
  double slant;       // distance / z: 0 in orthographic projection
  double coordinate;  // the largest of the numbers that the camera's place is subtracted from
};

Expected expected_of(const reference::Splat& splat, const Frame& frame) {
  const DrawnComponent& component = frame.components.front();
  Expected expected{splat, 0, 0, 0, 0};
  double squared = 0, z = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double from_origin = frame.camera.position.a[axis] - component.particles.origin.a[axis];
    const double d =
        static_cast<double>(component.particles.position[3 * splat.particle + axis]) - from_origin;
    squared += d * d;
    z += d * frame.camera.forward.a[axis];
    expected.coordinate = std::max(expected.coordinate, std::abs(from_origin));
  }
  expected.distance = std::sqrt(squared);
  const bool perspective = frame.projection == Projection::perspective;
  expected.scale = perspective ? frame.camera.focal_pixels / z : frame.camera.pixels_per_length;
  expected.slant = perspective ? expected.distance / z : 0;
  return expected;
}

// Roundings of x = centre + dot(d, right) * scale with d = (p - high) - low:
//   d        two, and the low part's own, 2^-24 of what high leaves: 2^-48 of the coordinate
//   dot      of the axis, the product and two sums: with those of d six, of |d| at most
//   scale    z errs like dot, by six of |d| / z; focal length 1, division 5 (2.5 ulp)
//   x        the product 1, the sum and the centre 1 each
// and a whole unit of the integers that places are (of `unit_pixels`).
double center_bound(const Expected& e, double x, double center, double unit_pixels) {
  const double offset = x - center;
  const double lost_digits = 2 * std::sqrt(3.0) * unit * e.coordinate;
  return unit * (6 * e.scale * (e.distance + lost_digits) + (6 * e.slant + 7) * std::abs(offset) +
                 2 * (std::abs(x) + std::abs(center)) + std::abs(x)) +
         unit_pixels;
}

// Roundings of sigma: those of the scale, of h's and kernel's factors and products (5), and
// for the widening a square, a sum and a square root of 3 ulp (10).
double width_bound(const Expected& e) {
  return unit * (6 * e.slant + 6 + 5 + 10);
}

// What a lens adds errs by the roundings of a difference of scales: those of the scale and of two
// products, and no more in a sum of squares.
double lens_bound(const Expected& e, const Frame& frame) {
  return unit * (6 * e.slant + 6 + 4) * sigma_per_scale(frame.lens) * e.scale;
}

// Widths of splats as they are stored: widened for those that take the centre's value.
double stored_sigma(double sigma, const FramePlan& plan) {
  const bool by_mean = sigma < static_cast<double>(plan.splats.mean_sigma);
  return by_mean ? sigma : std::sqrt(sigma * sigma + static_cast<double>(plan.splats.widening));
}

class ProjectGeometry : public StageTest, public testing::WithParamInterface<bool> {
 protected:
  // Calls check(expected, splat, its place, plan) for every splat.
  template <class Check>
  void for_each_splat(const Frame& frame, Check check) const {
    Stages stages(device(), frame, GetParam());
    stages.project();
    const std::vector<shared::Splat> splats = stages.splats();
    const std::vector<reference::Splat> oracle = reference::project(frame);
    ASSERT_EQ(splats.size(), oracle.size()) << "every particle should be in view";
    for (std::size_t i = 0; i < splats.size(); ++i) {
      ASSERT_EQ(identity_of(splats[i]), oracle[i].particle);
      const PicturePlace place = place_of(splats[i], stages.layout(), stages.plan());
      check(expected_of(oracle[i], frame), splats[i], place, stages.plan());
      if (HasFatalFailure()) return;
    }
  }

  // How far from the oracle's centre a narrow splat in the picture lies at most, in its grid's
  // pixels.
  double farthest_narrow_center(const Frame& frame) const {
    double farthest = 0;
    int count = 0;
    for_each_splat(frame, [&](const Expected& e, const shared::Splat&, const PicturePlace& place,
                              const FramePlan&) {
      const bool is_inside =
          place.x >= 0 && place.x <= frame.width && place.y >= 0 && place.y <= frame.height;
      if (e.splat.sigma > 3 || !is_inside) return;
      ++count;
      const double dx = std::abs(place.x - e.splat.x), dy = std::abs(place.y - e.splat.y);
      farthest = std::max({farthest, dx / place.pixel, dy / place.pixel});
    });
    EXPECT_GT(count, 100);
    return farthest;
  }

  // The largest distance of a centre from the oracle's, in pixels.
  double expect_centers_and_widths(const Frame& frame) const {
    double farthest = 0;
    for_each_splat(frame, [&](const Expected& e, const shared::Splat& splat,
                              const PicturePlace& place, const FramePlan& plan) {
      const double dx = std::abs(place.x - e.splat.x), dy = std::abs(place.y - e.splat.y);
      farthest = std::max({farthest, dx, dy});
      const double unit_pixels = 0x1p-20 * place.pixel;
      ASSERT_LE(dx, center_bound(e, e.splat.x, frame.camera.center_x, unit_pixels));
      ASSERT_LE(dy, center_bound(e, e.splat.y, frame.camera.center_y, unit_pixels));
      // Drawn narrower where its grid is blurred: undone with three more roundings.
      const double drawn = static_cast<double>(splat.sigma);
      const double sigma =
          place.pixel * std::sqrt(drawn * drawn + plan.pyramid.blur_of(place.grid));
      const double expected = stored_sigma(e.splat.sigma, plan);
      // Either form is right where the width is at the limit between them.
      const double limit = static_cast<double>(plan.splats.mean_sigma);
      if (std::abs(e.splat.sigma - limit) < 1e-3 * limit) return;
      ASSERT_LE(std::abs(sigma - expected),
                (width_bound(e) + 3 * unit) * expected + lens_bound(e, frame));
    });
    RecordProperty("farthest_centre", std::to_string(farthest));
    return farthest;
  }
};

// In pixels, for pictures of 1000 pixels: the bound above at 45 degrees is 6 roundings of
// 1207 * 1.13 pixels for the offset, 14 of 500 for the scale and 5 of 1000.
constexpr double ordinary_bound = (6 * 1207 * 1.13 + 14 * 500 + 5 * 1000) * unit + 0x1p-20;

TEST_P(ProjectGeometry, CentersLieWithinAThousandthOfAPixel) {
  static_assert(ordinary_bound < 1.3e-3, "what the next line promises");
  EXPECT_LE(expect_centers_and_widths(seen({{12, -34, 56}}, 10, 45, {{0, 0, 0}}, 1)),
            ordinary_bound);
}

TEST_P(ProjectGeometry, CentersLieAsCloseInTheOrderedPlan) {
  Frame frame = seen({{12, -34, 56}}, 10, 45, {{0, 0, 0}}, 2);
  frame.components.front().absorption = {Absorption::Kind::gray, 0.2};
  EXPECT_LE(expect_centers_and_widths(frame), ordinary_bound);
}

TEST_P(ProjectGeometry, CentersAndWidthsHoldTheirBoundsForWideAndNarrowViews) {
  for (const double field_of_view : {1.0, 10.0, 100.0, 140.0})
    expect_centers_and_widths(seen({{12, -34, 56}}, 10, field_of_view, {{0, 0, 0}}, 3));
}

TEST_P(ProjectGeometry, CentersAndWidthsHoldTheirBoundsInOrthographicProjection) {
  Frame frame = seen({{12, -34, 56}}, 10, 45, {{0, 0, 0}}, 4);
  frame.projection = Projection::orthographic;
  expect_centers_and_widths(frame);
}

TEST_P(ProjectGeometry, CentersAndWidthsHoldTheirBoundsFarFromTheOriginOfCoordinates) {
  const Vec3 far = {{1e8, -2e8, 3e8}};
  EXPECT_LE(expect_centers_and_widths(seen(far, 10, 45, far, 5)), ordinary_bound);
  // Stored positions in steps of up to 32 units, exact as far as they go.
  EXPECT_LE(expect_centers_and_widths(seen(far, 1e4, 45, {{0, 0, 0}}, 6)), ordinary_bound);
}

// So bright that a place in single precision would show.
Frame of_bright_stars(Frame frame) {
  frame.components.front().brightness = 1e6;
  return frame;
}

// A unit of places in pictures of 1000 pixels, and half the last digit of 45 bits of them.
constexpr double unit_of_places = 0x1p-20 + 0x1p-36;

TEST_P(ProjectGeometry, CentersOfBrightStarsAreKnownToAUnit) {
  for (const double field_of_view : {1.0, 45.0, 140.0}) {
    EXPECT_LE(farthest_narrow_center(
                  of_bright_stars(seen({{12, -34, 56}}, 10, field_of_view, {{0, 0, 0}}, 11))),
              unit_of_places);
  }
}

TEST_P(ProjectGeometry, CentersOfBrightStarsAreKnownAsWellFarFromTheOrigin) {
  const Vec3 far = {{1e8, -2e8, 3e8}};
  EXPECT_LE(farthest_narrow_center(of_bright_stars(seen(far, 10, 45, far, 12))), unit_of_places);
}

TEST_P(ProjectGeometry, CentersOfBrightStarsAreKnownAsWellInOrthographicProjection) {
  Frame frame = of_bright_stars(seen({{12, -34, 56}}, 10, 45, {{0, 0, 0}}, 13));
  frame.projection = Projection::orthographic;
  // Close to the picture's middle single precision may be taken, which is nearly as good there.
  EXPECT_LE(farthest_narrow_center(frame), 2 * unit_of_places);
}

TEST_P(ProjectGeometry, CentersOfACropAreThoseOfThePicture) {
  Frame frame = seen({{12, -34, 56}}, 10, 45, {{0, 0, 0}}, 7);
  // A margin is left out; every cloud is wide enough to reach into the crop.
  for (DrawnComponent& component : frame.components) {
    component.particles.smoothing_length = Column::uniform(3);
    component.particles.weight = Column::uniform(1);
  }
  frame.crop = {300, 250, 400, 300};
  EXPECT_LE(expect_centers_and_widths(frame), ordinary_bound);
}

TEST_P(ProjectGeometry, WidthsFollowTheSmallestRadius) {
  Frame frame = seen({{12, -34, 56}}, 10, 45, {{0, 0, 0}}, 8);
  frame.kernel.min_radius_pixels = 1.5;
  expect_centers_and_widths(frame);
}

TEST_P(ProjectGeometry, WidthsFollowTheFootprint) {
  Frame frame = seen({{12, -34, 56}}, 10, 45, {{0, 0, 0}}, 8);
  frame.kernel.footprint_pixels = 0.5;
  expect_centers_and_widths(frame);
}

TEST_P(ProjectGeometry, WidthsFollowTheLens) {
  Frame frame = seen({{12, -34, 56}}, 10, 45, {{0, 0, 0}}, 8);
  frame.lens = {0.02 * frame.camera.look_at_distance, frame.camera.look_at_distance};
  expect_centers_and_widths(frame);
}

// Roundings of w: sigma in world units 3, squared by two divisions of 5 each; the scale of
// weights 2; for the narrowing the square of sigma / sigma', each within its bound; the
// normalised intensity 4, of a value of at least 0.1 of its range; products 4.
double weight_bound(const Expected& e) {
  return unit * (2 * 3 + 2 * 5 + 2 + 2 * 5 + 4 / 0.1 + 4) + 4 * width_bound(e);
}

// Each with kernel.min_radius, and with kernel.footprint.
std::vector<std::pair<WeightModel, bool>> all_pairs(std::initializer_list<WeightModel> models) {
  std::vector<std::pair<WeightModel, bool>> pairs;
  for (const WeightModel model : models) {
    pairs.emplace_back(model, true);
    pairs.emplace_back(model, false);
  }
  return pairs;
}

TEST_P(ProjectGeometry, WeightsAreTheOraclesInEveryModel) {
  const auto models = {WeightModel::mass, WeightModel::density, WeightModel::constant};
  for (const auto& [model, is_widened] : all_pairs(models)) {
    Frame frame = seen({{12, -34, 56}}, 10, 45, {{0, 0, 0}}, 9);
    DrawnComponent& component = frame.components.front();
    component.weight = model;
    component.reference_column = 3.7;
    component.size_factor = 1.3;
    frame.kernel.min_radius_pixels = is_widened ? 0.4 : 0;
    frame.kernel.footprint_pixels = is_widened ? 0 : 0.4;
    Random random(10);
    std::vector<float> intensities;
    for (std::size_t i = 0; i < component.particles.count; ++i)
      intensities.push_back(static_cast<float>(random.uniform(-1.6, 2)));
    component.particles.intensity = Column::owning(intensities);
    component.intensity = {Scaling::linear, -2, 2};
    // A faint splat may carry the light back that its end leaves out, at most the truncation's
    // share of it as absorption shows it: share / 0.37.
    const double restored = make_plan(frame).shares.truncation / 0.36;
    for_each_splat(frame, [&](const Expected& e, const shared::Splat& splat,
                              const PicturePlace& place, const FramePlan& plan) {
      const double sigma = e.splat.sigma;
      const double narrowing = sigma / stored_sigma(sigma, plan);
      const double limit = static_cast<double>(plan.splats.mean_sigma);
      if (std::abs(sigma - limit) < 1e-3 * limit) return;
      // Drawn narrower, it carries the same light: undone with eight more roundings.
      const double drawn = static_cast<double>(splat.sigma);
      const double spread = 1 + plan.pyramid.blur_of(place.grid) / (drawn * drawn);
      const double expected = e.splat.weight * narrowing * narrowing * spread;
      const double bound = weight_bound(e) + 8 * unit;
      ASSERT_GE(static_cast<double>(splat.weight), expected * (1 - bound));
      ASSERT_LE(static_cast<double>(splat.weight), expected * (1 + restored + bound));
    });
  }
}

INSTANTIATE_TEST_SUITE_P(Lanes, ProjectGeometry, testing::Bool(), [](const auto& info) {
  return std::string(info.param ? "eight" : "one");
});

}  // namespace
}  // namespace splotchcl::test
