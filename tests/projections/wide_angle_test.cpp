// Wide angles: their keys, and the promise in random scenes.
#include "device/stages.h"
#include "frames/random_frames.h"
#include "frames/random_promise.h"
#include "projections/wide_frames.h"
#include "splotchcl/stereo.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// Where the device puts particles in wide angles, and in which order, is the reference's.

Frame ball_around_the_camera(Projection projection, const Vec3& center, double radius) {
  constexpr std::size_t count = 3001;
  Random random(7);
  std::vector<float> positions;
  for (std::size_t i = 0; i < 3 * count; ++i)
    positions.push_back(static_cast<float>(radius * random.uniform(-1, 1)));
  DrawnComponent component;
  component.particles.count = count;
  component.particles.origin = center;
  component.particles.position = Column::owning(positions);
  component.particles.smoothing_length = Column::uniform(static_cast<float>(0.01 * radius));
  component.weight = WeightModel::constant;
  component.reference_column = 1 / (0.01 * radius);
  Camera camera;
  camera.position = center + Vec3{{0.1, 0.03, -0.2}} * radius;
  camera.look_at = camera.position + Vec3{{0.4, -0.3, 0.8}} * radius;
  camera.projection = projection;
  if (projection == Projection::fisheye) camera.field_of_view_degrees = 360;
  const int height = projection == Projection::equirectangular ? 100 : 200;
  Frame frame = frame_of(200, height, {component});
  frame.projection = projection;
  frame.camera = make_camera_frame(camera, 200, height);
  return with_identities(frame);
}

void expect_keys_and_places_of_the_oracle(DeviceContext& device, const Frame& frame, bool lanes) {
  Stages stages(device, frame, lanes);
  stages.project();
  std::multimap<std::uint64_t, reference::Splat> expected;
  for (const reference::Splat& splat : reference::project(stages.frame()))
    expected.emplace(splat.particle, splat);
  // With the widths of ellipses behind each.
  const std::size_t words = stages.context().variant.splat_bytes() / sizeof(float);
  const std::vector<std::uint64_t> keys = stages.keys();
  const std::vector<std::uint32_t> slots = stages.slots();
  ASSERT_GT(keys.size(), 400u);
  const auto values = stages.read_as<float>(stages.keyed().splats, (slots.back() + 1) * words);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    shared::Splat splat;
    std::memcpy(&splat, values.data() + slots[i] * words, sizeof(splat));
    const auto [first, last] = expected.equal_range(identity_of(splat));
    ASSERT_NE(first, last) << "a particle that the reference leaves out";
    ASSERT_EQ(keys[i], first->second.key) << "particle " << identity_of(splat);
    const PicturePlace place = place_of(splat, stages.layout(), stages.plan());
    if (place.grid != 0) continue;
    double nearest = 1e300;
    for (auto copy = first; copy != last; ++copy) {
      nearest = std::min(nearest, std::hypot(place.x - copy->second.x, place.y - copy->second.y));
    }
    // A rounding of the direction is as wide as the picture's 64 pixels per radian make it,
    // and near a pole or behind a fisheye wider by the distance to the axis.
    EXPECT_LT(nearest, 2e-2) << "particle " << identity_of(splat);
  }
}

class WideAngleKeys : public StageTest,
                      public testing::WithParamInterface<std::tuple<Projection, bool>> {
 protected:
  Projection projection() const { return std::get<0>(GetParam()); }
  void expect(const Frame& frame) const {
    expect_keys_and_places_of_the_oracle(device(), frame, std::get<1>(GetParam()));
  }
};

TEST_P(WideAngleKeys, AreTheOraclesToTheBit) {
  expect(ball_around_the_camera(projection(), {{120, -340, 560}}, 100));
}

TEST_P(WideAngleKeys, HoldForLengthsWhoseSquaresDoNotFitAFloat) {
  expect(ball_around_the_camera(projection(), {{0, 0, 0}}, 3e24));
  expect(ball_around_the_camera(projection(), {{0, 0, 0}}, 3e-24));
}

TEST_P(WideAngleKeys, HoldForAnEyeBesideTheCamera) {
  Frame frame = ball_around_the_camera(projection(), {{0, 0, 0}}, 10);
  Stereo stereo;
  stereo.angle_degrees = 10;
  frame.camera = eye_camera(frame.camera, frame.projection, stereo, Eye::right);
  expect(frame);
}

INSTANTIATE_TEST_SUITE_P(Projections, WideAngleKeys,
                         testing::Combine(testing::Values(Projection::fisheye,
                                                          Projection::equirectangular,
                                                          Projection::cube),
                                          testing::Bool()));

// Random small scenes in wide angles, for one eye or two, keep their tolerance in both shapes
// of compositing.

// Light of discs that are cut so near a pixel's centre that it may be in or out, as in the
// tests of other random scenes, where places are known to so many pixels. Or of discs whose own
// centre lies on a pixel's edge: the pixel that holds it is never cut off.
std::vector<double> light_on_edges(const Frame& frame, double known_to) {
  std::vector<double> light(static_cast<std::size_t>(frame.crop.width) *
                            static_cast<std::size_t>(frame.crop.height));
  if (!frame.kernel.cut) return light;
  for (const reference::Splat& splat : reference::project(frame)) {
    const double radius = *frame.kernel.cut * splat.sigma;
    std::size_t i = 0;
    for (int y = frame.crop.y; y < frame.crop.y + frame.crop.height; ++y) {
      for (int x = frame.crop.x; x < frame.crop.x + frame.crop.width; ++x, ++i) {
        const double dx = x + 0.5 - splat.x, dy = y + 0.5 - splat.y;
        const double distance = std::hypot(dx / splat.stretch, dy);
        const double from_edge = std::max(std::abs(dx), std::abs(dy)) - 0.5;
        const bool on_disc = std::abs(distance - radius) <= known_to;
        const bool on_pixel = std::abs(from_edge) <= known_to && distance > radius - known_to;
        if (!on_disc && !on_pixel) continue;
        const double cut = on_pixel ? 0 : *frame.kernel.cut;
        light[i] += splat.weight * std::exp(-cut * cut) *
                    *std::max_element(splat.emission, splat.emission + 3);
      }
    }
  }
  return light;
}

class WideAngleScenes : public RandomPromise {
 protected:
  // In single precision: poles magnify.
  static constexpr double single_place = 1e-3;
  const RandomKind kind_ = {[](std::uint64_t seed) { return WideSceneMaker(seed).make(); }, 2.0 / 3,
                            light_on_edges, single_place};
};

TEST_F(WideAngleScenes, ShowAnEvenSkyEvenlyUpToThePolesOfAPanorama) {
  const Frame frame = wide_frame({Projection::equirectangular, 120, 60}, {even_sky(16000, 0.04)});
  for (const CompositeShape shape : {CompositeShape::rows, CompositeShape::groups}) {
    const Image image = draw(frame, shape);
    for (int y = 0; y < image.height; ++y) {
      double row = 0;
      for (int x = 0; x < image.width; ++x)
        row += static_cast<double>(*image.at(x, y)) / image.width;
      EXPECT_NEAR(row, 1, 0.02) << y;
    }
  }
}

TEST_F(WideAngleScenes, KeepTheirTolerance) {
  expect_tolerance_kept(kind_, seeds(1, 90, 13));
}

// Nearly every scene has kernels of its own, which take seconds to compile.
TEST_F(WideAngleScenes, KeepThePromiseOfToleranceZero) {
  expect_tolerance_zero_kept(kind_, seeds(2001, 2100));
}

}  // namespace
}  // namespace splotchcl::test
