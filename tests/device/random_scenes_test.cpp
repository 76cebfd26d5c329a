// Random small scenes over all settings keep their tolerance.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "device/pictures.h"
#include "device/scene_maker.h"
#include "long_tests.h"

namespace splotchcl::test {
namespace {

// docs/dev/accuracy.md, what single precision of places does to each pixel, in its brightest
// colour: a splat that moves by `known_to` pixels changes a pixel's light by as much as it
// slopes there, and the pixels on the edge of a cut disc may be in or out. Places are known to
// 2e-4 pixels in these pictures of up to 70.
std::vector<double> light_of_places(const Frame& frame, double known_to) {
  std::vector<double> light(static_cast<std::size_t>(frame.crop.width) *
                            static_cast<std::size_t>(frame.crop.height));
  for (const reference::Splat& splat : reference::project(frame)) {
    const double brightest =
        splat.weight * std::max(*std::max_element(splat.emission, splat.emission + 3),
                                *std::max_element(splat.absorption, splat.absorption + 3));
    // The mean over a pixel of a cloud of this width is as steep as that of one of a pixel.
    const double flux = brightest * std::min(1.0, pi * splat.sigma * splat.sigma);
    const double sigma = std::max(splat.sigma, 1e-3);
    std::size_t i = 0;
    for (int y = frame.crop.y; y < frame.crop.y + frame.crop.height; ++y) {
      for (int x = frame.crop.x; x < frame.crop.x + frame.crop.width; ++x, ++i) {
        const double dx = std::abs(x + 0.5 - splat.x), dy = std::abs(y + 0.5 - splat.y);
        // Of the pixel's edges the nearer; half a pixel is all that a mean can hide.
        const double u = std::max(std::hypot(dx, dy) - 0.8, 0.0) / sigma;
        light[i] += known_to * flux * 1.8 / sigma * (1 + u) * std::exp(-u * u);
        if (!frame.kernel.cut) continue;
        const double cut = *frame.kernel.cut;
        if (std::abs(std::hypot(dx, dy) - cut * splat.sigma) > known_to) continue;
        light[i] += brightest * std::exp(-cut * cut);
      }
    }
  }
  return light;
}

std::string describe(const Frame& frame) {
  std::ostringstream out;
  out << name(choose_light(frame)) << ", " << frame.crop.width << " x " << frame.crop.height
      << ", cut " << frame.kernel.cut.value_or(0)
      << (frame.kernel.sampling == Sampling::mean ? ", means" : ", centres") << ", min_radius "
      << frame.kernel.min_radius_pixels << ", tolerance " << frame.tolerance << ", components "
      << frame.components.size();
  return out.str();
}

// As largest_error(), where each pixel's error may be larger by `ambiguous` light.
double largest_error_beyond(const Image& image, const ReferenceImage& exact,
                            const std::vector<double>& ambiguous) {
  double worst = 0;
  for (std::size_t i = 0; i < exact.pixels.size(); ++i) {
    if (i % 4 == 3) continue;
    const double error = std::abs(static_cast<double>(image.pixels[i]) - exact.pixels[i]);
    const double beyond = error - ambiguous[i / 4];
    worst = std::max(
        worst, std::isfinite(beyond) ? beyond / std::max(1.0, std::abs(exact.pixels[i])) : 1e300);
  }
  return worst;
}

class RandomScenes : public PictureTest {};

TEST_F(RandomScenes, KeepTheirTolerance) {
  int drawn = 0, lit = 0;
  for (const std::uint64_t seed : seeds(1, 240, 13)) {
    ++drawn;
    const Frame frame = SceneMaker(seed).make();
    const ReferenceImage exact = reference::render(frame);
    lit += largest_value(exact) > 0.05;
    const CompositeShape shape = seed % 3 == 0 ? CompositeShape::groups : CompositeShape::rows;
    const double worst =
        largest_error_beyond(draw(frame, shape), exact, light_of_places(frame, 2e-4));
    EXPECT_LE(worst, frame.tolerance) << "seed " << seed << ": " << describe(frame);
    EXPECT_EQ(renderer(shape).stats().bad_particles, reference::count_bad(frame))
        << "seed " << seed;
  }
  EXPECT_GT(8 * lit, 5 * drawn) << "most scenes should have something to see";
}

// At tolerance 0 with numbers that are doubles and pairs of floats in turn; places are known
// to 2^-40 of coordinates, which are some ten lengths or hundreds of pixels.
TEST_F(RandomScenes, KeepThePromiseOfToleranceZero) {
  Renderer pairs({"", CompositeShape::automatic, false});
  for (const std::uint64_t seed : seeds(1001, 1080, 13)) {
    Frame frame = SceneMaker(seed).make();
    frame.tolerance = 0;
    const ReferenceImage exact = reference::render(frame);
    const Image image = seed % 2 == 0 ? pairs.render(frame) : draw(frame);
    EXPECT_LE(largest_error_beyond(image, exact, light_of_places(frame, 1e-9)), extended_tolerance)
        << "seed " << seed << ": " << describe(frame);
    const RenderStats& stats = seed % 2 == 0 ? pairs.stats() : renderer().stats();
    EXPECT_EQ(stats.bad_particles, reference::count_bad(frame)) << "seed " << seed;
  }
}

}  // namespace
}  // namespace splotchcl::test
