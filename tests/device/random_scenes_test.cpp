// Random small scenes over all settings keep their tolerance.
#include "frames/random_frames.h"
#include "frames/random_promise.h"
#include "testing.h"

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

class RandomScenes : public RandomPromise {
 protected:
  const RandomKind kind_ = {[](std::uint64_t seed) { return SceneMaker(seed).make(); }, 5.0 / 8,
                            light_of_places, 2e-4};
};

TEST_F(RandomScenes, KeepTheirTolerance) {
  expect_tolerance_kept(kind_, seeds(1, 240, 13));
}

// Places are known to 2^-40 of coordinates, which are some ten lengths or hundreds of pixels.
TEST_F(RandomScenes, KeepThePromiseOfToleranceZero) {
  expect_tolerance_zero_kept(kind_, seeds(1001, 1080, 13));
}

}  // namespace
}  // namespace splotchcl::test
