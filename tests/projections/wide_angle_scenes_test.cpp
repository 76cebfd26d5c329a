// Random small scenes in wide angles, for one eye or two, keep their tolerance in both shapes
// of compositing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "device/pictures.h"
#include "long_tests.h"
#include "projections/wide_scene_maker.h"

namespace splotchcl::test {
namespace {

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

std::string describe(const Frame& frame) {
  std::ostringstream out;
  out << name(choose_light(frame)) << ", projection " << static_cast<int>(frame.projection) << ", "
      << frame.width << " x " << frame.height << ", cut " << frame.kernel.cut.value_or(0)
      << ", eye " << frame.camera.eye_offset << ", tolerance " << frame.tolerance;
  return out.str();
}

double worst_error(const Frame& frame, const Image& image, const ReferenceImage& exact,
                   double known_to) {
  const std::vector<double> ambiguous = light_on_edges(frame, known_to);
  double worst = 0;
  for (std::size_t i = 0; i < exact.pixels.size(); ++i) {
    if (i % 4 == 3) continue;
    const double error = std::abs(static_cast<double>(image.pixels[i]) - exact.pixels[i]);
    const double beyond = (error - ambiguous[i / 4]) / std::max(1.0, std::abs(exact.pixels[i]));
    worst = std::max(worst, std::isfinite(beyond) ? beyond : 1e300);
  }
  return worst;
}

class WideAngleScenes : public PictureTest {};

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

// Single precision: poles magnify.
constexpr double single_place = 1e-3;

TEST_F(WideAngleScenes, KeepTheirTolerance) {
  int drawn = 0, lit = 0;
  for (const std::uint64_t seed : seeds(1, 90, 13)) {
    ++drawn;
    const Frame frame = WideSceneMaker(seed).make();
    const ReferenceImage exact = reference::render(frame);
    lit += largest_value(exact) > 0.05;
    EXPECT_LE(worst_error(frame, draw(frame), exact, single_place), frame.tolerance)
        << "seed " << seed << ": " << describe(frame);
    if (seed % 3 != 0) continue;
    EXPECT_LE(worst_error(frame, draw(frame, CompositeShape::groups), exact, single_place),
              frame.tolerance)
        << "in groups, seed " << seed << ": " << describe(frame);
  }
  EXPECT_GT(3 * lit, 2 * drawn) << "most scenes should have something to see";
}

// With numbers that are doubles and pairs of floats, in both shapes in turn.
TEST_F(WideAngleScenes, KeepThePromiseOfToleranceZero) {
  Renderer pairs({"", CompositeShape::rows, false}),
      pairs_in_groups({"", CompositeShape::groups, false});
  // Nearly every scene has kernels of its own, which take seconds to compile.
  for (const std::uint64_t seed : seeds(2001, long_tests() ? 2100 : 2050)) {
    Frame frame = WideSceneMaker(seed).make();
    frame.tolerance = 0;
    const ReferenceImage exact = reference::render(frame);
    const CompositeShape shape = seed % 2 == 0 ? CompositeShape::rows : CompositeShape::groups;
    Renderer& by_pairs = seed % 2 == 0 ? pairs : pairs_in_groups;
    EXPECT_LE(worst_error(frame, draw(frame, shape), exact, 1e-9), extended_tolerance)
        << "seed " << seed << ": " << describe(frame);
    EXPECT_LE(worst_error(frame, by_pairs.render(frame), exact, 1e-9), extended_tolerance)
        << "pairs, seed " << seed << ": " << describe(frame);
    EXPECT_EQ(renderer(shape).stats().bad_particles, reference::count_bad(frame))
        << "seed " << seed;
  }
}

}  // namespace
}  // namespace splotchcl::test
