// Projections of the oracle.
#include <mutex>

#include "frames.h"
#include "reference/frames.h"
#include "splotchcl/reference.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// Which particles are drawn, where, how large and how bright.

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

Frame perspective_frame(const std::vector<Cloud>& clouds) {
  Frame frame = frame_of(100, 80, {component_of(clouds, one_color(1, 1, 1))});
  frame.projection = Projection::perspective;
  frame.camera.focal_pixels = 50;
  return frame;
}

DrawnComponent one_particle() {
  return component_of({Cloud{}}, one_color(1, 1, 1));
}

std::vector<std::uint64_t> drawn(const Frame& frame) {
  std::vector<std::uint64_t> particles;
  for (const auto& splat : reference::project(frame))
    particles.push_back(splat.particle);
  return particles;
}

TEST(Project, PerspectiveDividesByDepth) {
  const auto splats = reference::project(perspective_frame({Cloud{3, -2, 10, 0.4, 2}}));
  ASSERT_EQ(splats.size(), 1u);
  EXPECT_NEAR(splats[0].x, 50 + 50 * 3.0 / 10, 1e-12);
  EXPECT_NEAR(splats[0].y, 40 - 50 * 2.0 / 10, 1e-12);
  EXPECT_NEAR(splats[0].sigma, 0.4 * 50 / 10, 1e-6);
  EXPECT_NEAR(splats[0].weight, 2, 1e-6);
}

TEST(Project, OrthographicEqualsPerspectiveFromFarAway) {
  // Seen from 1e6 lengths, with a lens that makes the plane of the look-at point as large.
  Frame far = frame_of(64, 64, {component_of({Cloud{5, -3, 0.5, 2, 1}}, one_color(1, 1, 1))});
  far.camera.position = {{0, 0, -1e6}};
  far.projection = Projection::perspective;
  far.camera.focal_pixels = 1e6;
  Frame flat = far;
  flat.projection = Projection::orthographic;
  const auto a = reference::project(far);
  const auto b = reference::project(flat);
  ASSERT_EQ(a.size(), 1u);
  ASSERT_EQ(b.size(), 1u);
  // z differs from the look-at distance by 0.5 in 1e6.
  EXPECT_NEAR(a[0].x, b[0].x, 5e-6);
  EXPECT_NEAR(a[0].y, b[0].y, 5e-6);
  EXPECT_NEAR(a[0].sigma, b[0].sigma, 5e-6);
  EXPECT_EQ(a[0].weight, b[0].weight);
}

TEST(Project, AFarOriginKeepsThePositionsDigits) {
  Frame frame = perspective_frame({Cloud{0.001, 0, 10, 1, 1}});
  frame.camera.position = {{1e9, 1e9, 1e9}};
  frame.components[0].particles.origin = {{1e9, 1e9, 1e9}};
  EXPECT_NEAR(reference::project(frame)[0].x, 50 + 50 * 0.001 / 10, 1e-9);
}

TEST(Weight, OfMassIsTheColumnDensity) {
  Frame frame = frame_of(8, 8, {one_particle()});
  frame.kernel.width = 0.5;
  frame.components[0].particles.weight = Column::uniform(12);
  frame.components[0].particles.smoothing_length = Column::uniform(4);
  frame.components[0].size_factor = 3;  // sigma = 6
  frame.components[0].reference_column = 2;
  EXPECT_NEAR(reference::project(frame)[0].weight, 12 / (pi * 36) / 2, 1e-15);
}

TEST(Weight, OfDensityIsItsColumnThroughTheCenter) {
  Frame frame = frame_of(8, 8, {one_particle()});
  frame.kernel.width = 0.5;
  frame.components[0].weight = WeightModel::density;
  frame.components[0].particles.weight = Column::uniform(7);
  frame.components[0].particles.smoothing_length = Column::uniform(4);
  EXPECT_NEAR(reference::project(frame)[0].weight, 7 * 2 * std::sqrt(pi), 1e-13);
}

TEST(Weight, ConstantIsOneOverH) {
  Frame frame = frame_of(8, 8, {one_particle()});
  frame.components[0].weight = WeightModel::constant;
  frame.components[0].particles.weight = Column();
  frame.components[0].particles.smoothing_length = Column::uniform(4);
  frame.components[0].size_factor = 2;
  EXPECT_EQ(reference::project(frame)[0].weight, 0.125);
}

TEST(Weight, CarriesTheNormalizedIntensity) {
  Frame frame = frame_of(8, 8, {one_particle()});
  frame.components[0].particles.intensity = Column::uniform(100);
  frame.components[0].intensity = {Scaling::log, 0, 8};
  EXPECT_NEAR(reference::project(frame)[0].weight, 0.25, 1e-7);
}

double red_of(const ScalarMap& map, float value) {
  Frame frame = frame_of(8, 8, {one_particle()});
  frame.components[0].palette.emission = {Rgb{0, 0, 0}, Rgb{1, 0, 0}};
  frame.components[0].color = map;
  frame.components[0].particles.color = Column::uniform(value);
  return reference::project(frame)[0].emission[0];
}

TEST(ColorScalar, IsScaledThenClampedToItsRange) {
  EXPECT_NEAR(red_of({Scaling::linear, 2, 4}, 2.5f), 0.25, 1e-15);
  EXPECT_NEAR(red_of({Scaling::log, -1, 3}, 10), 0.5, 1e-15);
  EXPECT_NEAR(red_of({Scaling::asinh, 0, 2}, 1), std::asinh(1) / 2, 1e-15);
  EXPECT_EQ(red_of({Scaling::linear, 2, 4}, 9), 1);
  EXPECT_EQ(red_of({Scaling::linear, 2, 4}, 1), 0);
}

TEST(ColorScalar, TakesTheFirstColorWhereItHasNoPlace) {
  EXPECT_EQ(red_of({Scaling::log, -1, 3}, 0), 0);
  EXPECT_EQ(red_of({Scaling::log, -1, 3}, -5), 0);
  EXPECT_EQ(red_of({Scaling::linear, 2, 2}, 5), 0);
}

TEST(Absorption, DefaultsToTheEmission) {
  Frame frame = frame_of(8, 8, {component_of({Cloud{}}, one_color(1, 0.5f, 0.25f))});
  frame.components[0].brightness = 3;
  const auto splat = reference::project(frame)[0];
  EXPECT_EQ(splat.emission[1], 1.5);
  EXPECT_EQ(splat.absorption[1], 1.5);
}

TEST(Absorption, UsesThePalettesOwnColorsWhereItHasThem) {
  Frame frame = frame_of(8, 8, {component_of({Cloud{}}, one_color(1, 0.5f, 0.25f))});
  frame.components[0].brightness = 3;
  frame.components[0].palette.absorption = {Rgb{0, 0.25f, 1}};
  EXPECT_EQ(reference::project(frame)[0].absorption[1], 0.75);
  frame.components[0].absorption = {Absorption::Kind::factor, 8};
  EXPECT_EQ(reference::project(frame)[0].absorption[1], 2);
  frame.components[0].absorption.kind = Absorption::Kind::none;
  EXPECT_EQ(reference::project(frame)[0].absorption[1], 0);
}

TEST(NearLimit, DefaultsToATenthOfTheParticlesOwnSizeInPerspective) {
  Frame frame = perspective_frame({Cloud{0, 0, 0.9, 10}, Cloud{0, 0, 1.1, 10}, Cloud{0, 0, -1, 1}});
  EXPECT_EQ(drawn(frame), (std::vector<std::uint64_t>{1}));
  frame.components[0].size_factor = 0.5;
  EXPECT_EQ(drawn(frame), (std::vector<std::uint64_t>{0, 1}));
}

TEST(NearLimit, GivenReplacesTheDefaultButNeverReachesBehindThePerspectiveCamera) {
  Frame frame = perspective_frame({Cloud{0, 0, 0.9, 10}, Cloud{0, 0, 0, 10}, Cloud{0, 0, -1, 1}});
  frame.near_limit = -5;
  EXPECT_EQ(drawn(frame), (std::vector<std::uint64_t>{0}));
}

TEST(NearLimit, IsTheCameraPlaneInOrthographic) {
  Frame frame = frame_of(
      8, 8, {component_of({Cloud{0, 0, 0.1, 10}, Cloud{0, 0, -0.1, 10}}, one_color(1, 1, 1))});
  EXPECT_EQ(drawn(frame), (std::vector<std::uint64_t>{0}));
  frame.near_limit = -1;
  EXPECT_EQ(drawn(frame), (std::vector<std::uint64_t>{0, 1}));
}

TEST(FarLimit, LeavesOutWhatLiesBeyond) {
  Frame frame = perspective_frame({Cloud{0, 0, 5, 1}, Cloud{0, 0, 7, 1}});
  frame.far_limit = 6;
  EXPECT_EQ(drawn(frame), (std::vector<std::uint64_t>{0}));
}

TEST(Project, LeavesNothingOutForLyingOffThePicture) {
  EXPECT_EQ(reference::project(perspective_frame({Cloud{1e6, 0, 1, 0.1}})).size(), 1u);
}

TEST(BadParticles, AreLeftOutAndCounted) {
  Frame frame = perspective_frame(std::vector<Cloud>(12, Cloud{0, 0, 10, 1, 1}));
  Particles& particles = frame.components[0].particles;
  std::vector<float> position(36, 1), h(12, 1), weight(12, 1), color(12, 1), intensity(12, 1),
      key(12, 1);
  position[3 * 1 + 2] = nan;
  position[3 * 2] = infinity;
  h[3] = 0;
  h[4] = -1;
  h[5] = nan;
  weight[6] = -1;
  weight[7] = infinity;
  color[8] = nan;
  intensity[9] = -infinity;
  weight[10] = 0;  // odd, not bad
  key[11] = nan;
  particles.position = Column::owning(position);
  particles.smoothing_length = Column::owning(h);
  particles.weight = Column::owning(weight);
  particles.color = Column::owning(color);
  particles.intensity = Column::owning(intensity);
  particles.sort_field = Column::owning(key);
  EXPECT_EQ(drawn(frame), (std::vector<std::uint64_t>{0, 10}));
  EXPECT_EQ(reference::count_bad(frame), 10u);
}

TEST(Project, NumbersParticlesThroughAllComponents) {
  Frame frame = perspective_frame({Cloud{0, 0, -1}, Cloud{0, 0, 5}});
  frame.components.push_back(frame.components[0]);
  EXPECT_EQ(drawn(frame), (std::vector<std::uint64_t>{1, 3}));
}

// Who waits for the reference is told how far it is, and may end it.

Frame some_frame() {
  Cloud cloud;
  cloud.sigma = 5;
  Palette palette;
  palette.emission = {Rgb{1.0f, 0.5f, 0.25f}};
  return frame_of(64, 200, {component_of({cloud}, palette)});
}

TEST(ReferenceProgress, GrowsToTheWholeFrame) {
  std::vector<double> told;
  std::mutex mutex;
  reference::render(some_frame(), [&](double fraction) {
    const std::lock_guard<std::mutex> lock(mutex);
    told.push_back(fraction);
  });
  ASSERT_FALSE(told.empty());
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_EQ(told.back(), 1);
}

// Each thread asks once more at most, so that a picture of many rows ends long before its end.
TEST(ReferenceProgress, EndsAllThreadsByWhatItThrows) {
  int calls = 0;
  std::mutex mutex;
  const auto stop = [&](double) {
    const std::lock_guard<std::mutex> lock(mutex);
    ++calls;
    throw std::runtime_error("enough");
  };
  EXPECT_THROW(reference::render(some_frame(), stop), std::runtime_error);
  EXPECT_GE(calls, 1);
}

TEST(ReferenceProgress, DoesNotChangeThePicture) {
  const Frame frame = some_frame();
  EXPECT_EQ(reference::render(frame, [](double) {}).pixels, reference::render(frame).pixels);
}

// What a lens and fading with depth do to splats, by the reference renderer.

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
