#include "device/pictures.h"
#include "device/stages.h"
#include "projections/wide_frames.h"
#include "splotchcl/stereo.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// How well places and widths in wide angles are known, in single precision and in extended
// numbers: the bounds of docs/dev/accuracy.md.

// What the device made of a particle; widths along x are 0 but in panoramas.
struct Placed {
  std::uint64_t particle = 0;
  double x = 0, y = 0, sigma = 0, sigma_x = 0;
  bool has_coarse_unit = false;  // of its integers
  bool is_face_width = false;    // sigma is that of FaceEllipse::squared_width
};

// Errors in pixels, those of widths relative.
struct Errors {
  double x = 0, y = 0, sigma = 0, sigma_x = 0;
};

Errors largest(const Errors& a, const Errors& b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.sigma, b.sigma),
          std::max(a.sigma_x, b.sigma_x)};
}

double number(const float* pair) {
  return static_cast<double>(pair[0]) + static_cast<double>(pair[1]);
}

class WideAnglePlaces : public StageTest,
                        public testing::WithParamInterface<std::tuple<Projection, double>> {
 protected:
  // Clouds all around the camera, for one eye beside it where the angle is not 0. Lengths are
  // some of this unit.
  static Frame clouds_around(int width, double unit) {
    const auto [projection, eye_angle] = GetParam();
    Random random(83);
    std::vector<float> positions;
    while (positions.size() < 3 * 20000) {
      const Vec3 at = {{random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3)}};
      if (std::hypot(at.a[0], at.a[1], at.a[2]) < 1) continue;
      for (const double coordinate : at.a)
        positions.push_back(static_cast<float>(unit * coordinate));
    }
    DrawnComponent component;
    component.particles.count = positions.size() / 3;
    component.particles.position = Column::owning(positions);
    component.particles.smoothing_length = Column::uniform(static_cast<float>(0.03 * unit));
    component.weight = WeightModel::constant;
    component.reference_column = 1 / unit;
    // Sums have coarse grids.
    component.absorption = {Absorption::Kind::gray, 0.2};
    Camera camera;
    camera.position = Vec3{{0.1, 0.03, -0.2}} * unit;
    camera.look_at = Vec3{{0.5, -0.27, 0.6}} * unit;
    camera.projection = projection;
    if (projection == Projection::fisheye) camera.field_of_view_degrees = 360;
    const int height = projection == Projection::equirectangular ? width / 2 : width;
    Frame frame = frame_of(width, height, {component});
    frame.projection = projection;
    frame.camera = make_camera_frame(camera, width, height);
    Stereo stereo;
    stereo.angle_degrees = eye_angle;
    if (eye_angle > 0) frame.camera = eye_camera(frame.camera, projection, stereo, Eye::right);
    return with_identities(frame);
  }

  static std::vector<Placed> single_places(Stages& stages) {
    const std::size_t words = stages.context().variant.splat_bytes() / sizeof(float);
    const std::vector<std::uint32_t> slots = stages.slots();
    const std::size_t end = slots.empty() ? 0 : slots.back() + 1;
    const auto values = stages.read_as<float>(stages.keyed().splats, end * words);
    const double widening = static_cast<double>(stages.plan().splats.widening);
    std::vector<Placed> places;
    for (const std::size_t i : slots) {
      shared::Splat splat;
      std::memcpy(&splat, &values[i * words], sizeof(splat));
      const auto unwidened = [&](float sigma) {
        const double s = static_cast<double>(sigma);
        return s < static_cast<double>(stages.plan().splats.mean_sigma)
                   ? std::abs(s)
                   : std::sqrt(s * s - widening);
      };
      const PicturePlace place = place_of(splat, stages.layout(), stages.plan());
      places.push_back({identity_of(splat), place.x, place.y, unwidened(splat.sigma), 0});
      places.back().has_coarse_unit = splat.component_and_grid >> 24 > 0;
      const std::size_t after = sizeof(splat) / sizeof(float);
      if (stages.plan().has_ellipses) places.back().sigma_x = unwidened(values[i * words + after]);
    }
    return places;
  }

  static std::vector<Placed> extended_places(Stages& stages) {
    const Variant& variant = stages.context().variant;
    const std::size_t words = variant.splat_bytes() / sizeof(float);
    const std::size_t plain = words - variant.extended_splat_bytes() / sizeof(float);
    const std::vector<std::uint32_t> slots = stages.slots();
    const std::size_t end = slots.empty() ? 0 : slots.back() + 1;
    const auto values = stages.read_as<float>(stages.keyed().splats, end * words);
    std::vector<Placed> places;
    for (const std::size_t i : slots) {
      shared::Splat splat;
      std::memcpy(&splat, &values[i * words], sizeof(splat));
      const float* own = &values[i * words + plain];
      const shared::Grid& grid = stages.layout().grids.front();
      places.push_back({identity_of(splat), number(own) + grid.middle_x,
                        number(own + 2) + grid.middle_y, number(own + 4), 0});
      const std::size_t after = sizeof(shared::ExtendedSplat) / sizeof(float);
      if (stages.plan().is_face_of_cube) {
        // Single precision serves for the widths along the axes, not for this one.
        const std::size_t tilt = after + sizeof(shared::FloatPair) / sizeof(float);
        places.back().sigma = std::sqrt(number(own + tilt));
        places.back().is_face_width = true;
      } else if (stages.plan().has_ellipses) {
        places.back().sigma_x = number(own + after);
      }
    }
    return places;
  }

  // The largest errors, each as a part of what known_to() allows where a direction errs by
  // `direction`, and a place by `unit` pixels more.
  static Errors largest_errors(const Frame& frame, const std::vector<Placed>& places,
                               double direction, double unit = 0) {
    std::multimap<std::uint64_t, reference::Splat> expected;
    for (const reference::Splat& splat : reference::project(frame))
      expected.emplace(splat.particle, splat);
    Errors worst;
    EXPECT_GT(places.size(), 2000u);
    for (const Placed& place : places) {
      const auto [first, last] = expected.equal_range(place.particle);
      if (first == last) continue;
      const auto nearest = std::min_element(first, last, [&](const auto& a, const auto& b) {
        return std::abs(a.second.x - place.x) < std::abs(b.second.x - place.x);
      });
      Errors may = known_to(frame, nearest->second, direction);
      may.x += unit;
      may.y += unit;
      worst = largest(worst, parts_of(may, place, nearest->second));
    }
    return worst;
  }

  // The errors of a splat as parts of what they may be.
  static Errors parts_of(const Errors& may, const Placed& place, const reference::Splat& exact) {
    Errors parts;
    parts.x = std::abs(place.x - exact.x) / may.x;
    parts.y = std::abs(place.y - exact.y) / may.y;
    const double sigma = place.is_face_width ? std::sqrt(exact.on_face.squared_width) : exact.sigma;
    parts.sigma = std::abs(place.sigma / sigma - 1) / may.sigma;
    const double sigma_x = exact.sigma * exact.stretch;
    if (place.sigma_x > 0) parts.sigma_x = std::abs(place.sigma_x / sigma_x - 1) / may.sigma_x;
    return parts;
  }

  // The bounds of docs/dev/accuracy.md, "Wide angles".
  static Errors known_to(const Frame& frame, const reference::Splat& splat, double direction) {
    const CameraFrame& camera = frame.camera;
    const double f = camera.focal_pixels;
    const double x = splat.x - camera.center_x, y = splat.y - camera.center_y;
    double along_x = 1, along_y = 1;
    Errors known;
    known.sigma = known.sigma_x = direction;
    if (frame.projection == Projection::equirectangular) {
      along_x = 1 / std::cos(y / f);
      known.sigma_x *= along_x;
    } else if (frame.projection == Projection::fisheye) {
      const double angle = std::hypot(x, y) / f, sine = std::max(std::sin(angle), 1e-9);
      along_x = along_y = std::max(1.0, angle / sine);
      known.sigma /= std::max(sine, 0.1);
    } else {
      along_x = along_y = 1 + (x * x + y * y) / (f * f);
      known.sigma *= 2;
    }
    const double rounding = 0.1 * direction;
    known.x = direction * f * along_x + rounding * (4 * std::abs(x) + std::abs(splat.x));
    known.y = direction * f * along_y + rounding * (4 * std::abs(y) + std::abs(splat.y));
    return known;
  }
};

TEST_P(WideAnglePlaces, AreKnownToTheBoundOfSinglePrecision) {
  for (const int width : {256, 4096}) {
    const Frame frame = clouds_around(width, 1);
    Stages stages(device(), frame);
    stages.project();
    const Errors e = largest_errors(frame, single_places(stages), 10 * 0x1p-24);
    EXPECT_LE(std::max({e.x, e.y, e.sigma, e.sigma_x}), 1)
        << e.x << ", " << e.y << ", widths " << e.sigma << ", " << e.sigma_x;
  }
}

TEST_P(WideAnglePlaces, OfBrightStarsAreKnownToAUnit) {
  Frame frame = clouds_around(4096, 1);
  frame.components.front().brightness = 1e9;
  Stages stages(device(), frame);
  stages.project();
  std::vector<Placed> places = single_places(stages);
  // Those that reach far beyond the picture have coarser units.
  places.erase(std::remove_if(places.begin(), places.end(),
                              [](const Placed& place) { return place.has_coarse_unit; }),
               places.end());
  constexpr double unit = 0x1p-18;  // in pictures of 4096 pixels
  const Errors e = largest_errors(frame, places, 0x1p-41, unit);
  EXPECT_LE(std::max(e.x, e.y), 1) << e.x << ", " << e.y;
}

TEST_P(WideAnglePlaces, AreKnownToFortyBitsInExtendedPrecision) {
  for (const double unit : {1.0, 3e24, 3e-24}) {
    Frame frame = clouds_around(4096, unit);
    frame.tolerance = 0;
    Stages stages(device(), frame);
    stages.project();
    const Errors e = largest_errors(frame, extended_places(stages), 0x1p-41);
    EXPECT_LE(std::max({e.x, e.y, e.sigma, e.sigma_x}), 1)
        << e.x << ", " << e.y << ", widths " << e.sigma << ", " << e.sigma_x << ", unit " << unit;
  }
}

INSTANTIATE_TEST_SUITE_P(Views, WideAnglePlaces,
                         testing::Combine(testing::Values(Projection::fisheye,
                                                          Projection::equirectangular,
                                                          Projection::cube),
                                          testing::Values(0.0, 10.0)));

// A crop has the bits of the whole picture, in every projection, where both are drawn with the same
// plan.

const std::vector<Projection> projections = {Projection::perspective, Projection::orthographic,
                                             Projection::fisheye, Projection::equirectangular,
                                             Projection::cube};
const std::vector<Projection> some_projections = {Projection::equirectangular, Projection::cube};

// Clouds all around the camera, some in front of others.
Frame clouds_around(Projection projection, bool ordered, double tolerance) {
  Random random(71);
  std::vector<Cloud> clouds;
  for (int i = 0; i < 300; ++i) {
    const Vec3 direction = {{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}};
    clouds.push_back(cloud_towards(direction, random.uniform(0.5, 2), random.logarithmic(2e-3, 0.5),
                                   random.logarithmic(0.01, 3)));
  }
  WideCamera camera;
  camera.projection = projection;
  camera.width = 98;
  camera.height = projection == Projection::cube ? 98 : 49;
  Frame frame = wide_frame(camera, {component_of(clouds, two_colors())});
  frame.components.front().absorption = {ordered ? Absorption::Kind::gray : Absorption::Kind::none,
                                         0.2};
  frame.tolerance = tolerance;
  return frame;
}

Image part_of(const Image& whole, const Rectangle& crop) {
  Image part(crop.width, crop.height);
  for (int y = 0; y < crop.height; ++y)
    std::copy_n(whole.at(crop.x, crop.y + y), 4 * crop.width, part.at(0, y));
  return part;
}

template <class Draw>
void expect_equal_bits(const std::vector<Projection>& of, Draw draw, double tolerance) {
  for (const Projection projection : of) {
    for (const bool ordered : {false, true}) {
      Frame frame = clouds_around(projection, ordered, tolerance);
      const Image whole = draw(frame);
      ASSERT_GT(*std::max_element(whole.pixels.begin(), whole.pixels.end()), 0.1f);
      for (const Rectangle& crop : {Rectangle{0, 0, 50, 40}, Rectangle{37, 13, 61, 36},
                                    Rectangle{97, 48, 1, 1}, Rectangle{0, 23, 98, 1}}) {
        frame.crop = crop;
        EXPECT_EQ(draw(frame).pixels, part_of(whole, crop).pixels)
            << "projection " << static_cast<int>(projection) << ", crop at " << crop.x << ", "
            << crop.y << (ordered ? ", ordered" : "");
      }
    }
  }
}

class WideAngleCrops : public PictureTest {};

TEST_F(WideAngleCrops, HaveTheBitsOfThePicture) {
  DeviceContext device(choose_device(""));
  for (const CompositeShape shape : {CompositeShape::rows, CompositeShape::groups}) {
    const auto draw = [&](const Frame& frame) { return draw_once(device, frame, shape); };
    // Kernels made for GPUs take a processor's compiler seconds each.
    const bool has_all = shape == CompositeShape::rows || long_tests();
    expect_equal_bits(has_all ? projections : some_projections, draw, 1e-3);
  }
}

TEST_F(WideAngleCrops, HaveTheBitsOfThePictureAtToleranceZero) {
  expect_equal_bits(
      projections, [](const Frame& frame) { return renderer().render(frame); }, 0);
}

TEST_F(WideAngleCrops, HaveThemInGroupsAtToleranceZero) {
  Renderer groups({"", CompositeShape::groups});
  expect_equal_bits(
      some_projections, [&](const Frame& frame) { return groups.render(frame); }, 0);
}

}  // namespace
}  // namespace splotchcl::test
