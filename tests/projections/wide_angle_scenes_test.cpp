// Random small scenes in wide angles, for one eye or two, keep their tolerance in both shapes
// of compositing.
#include "frames/random_frames.h"
#include "frames/random_promise.h"
#include "testing.h"

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
