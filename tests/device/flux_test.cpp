// In optically thin scenes the light of a picture, added up, is that of its particles: at
// any resolution, wherever they fall between pixels, and however small they are.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "device/pictures.h"

namespace splotchcl::test {
namespace {

// A sum of emission may lose or gain the tolerance, as a part of itself. Behind absorption
// the same tolerance allows a part e of every splat with 0.37 e <= tolerance, since depths
// x show as 1 - exp(-x), whose error is e x exp(-x) (docs/dev/accuracy.md).
double flux_bound(const Frame& frame, LightPlan plan) {
  return plan == LightPlan::emission ? frame.tolerance : frame.tolerance / 0.367;
}

Frame thin(Frame frame, LightPlan plan) {
  for (DrawnComponent& component : frame.components) {
    if (plan == LightPlan::emission) component.absorption = {Absorption::Kind::none, 0};
    if (plan == LightPlan::ordered) component.palette.absorption = component.palette.emission;
  }
  EXPECT_EQ(choose_light(frame), plan);
  return frame;
}

class Flux : public PictureTest, public testing::WithParamInterface<LightPlan> {};

// h from 1e-4 pixels on, so sigma = h: the frames of tests have kernel.width 1.
TEST_P(Flux, OfOneParticleDependsNeitherOnItsSizeNorOnItsPlaceBetweenPixels) {
  for (const double sigma :
       {1e-4, 1e-3, 1e-2, 0.1, 0.3, 0.7, 1.0, 1.5, 1.9, 2.0, 2.1, 3.0, 5.0, 8.0}) {
    for (const double shift : {0.0, 0.13, 0.5, 0.77}) {
      // A depth of 1e-5 in the brightest pixel: absorption takes 5e-6 of the light.
      const double column = 1e-5 / std::min(1.0, pi * sigma * sigma);
      const Frame frame = thin(
          frame_of(
              96, 80,
              {component_of({{1 + shift, 2 - 0.6 * shift, 1, sigma, column}}, one_color(1, 1, 1))}),
          GetParam());
      const double expected = column * pi * sigma * sigma;
      EXPECT_NEAR(sum_of_light(draw(frame)) / expected, 1, flux_bound(frame, GetParam()))
          << "sigma " << sigma << ", shift " << shift;
    }
  }
}

// Clouds of sizes from 1e-4 to 1/12 of the picture's width, all of whose light is in it.
DrawnComponent field_of_clouds(double world) {
  Random random(91);
  std::vector<Cloud> clouds;
  for (int i = 0; i < 300; ++i) {
    const double sigma = world * random.logarithmic(1e-5, 0.06);
    // Equal light from each, spread over a part of the picture of 1e-4 optical depths.
    clouds.push_back({world * random.uniform(-0.2, 0.2), world * random.uniform(-0.2, 0.2),
                      random.uniform(1, 10), sigma, 1e-9 * world * world / (sigma * sigma)});
  }
  return component_of(clouds, one_color(1, 1, 1));
}

TEST_P(Flux, OfASceneIsTheSameAtAnyResolution) {
  constexpr double world = 100;
  double expected = 0;
  const DrawnComponent clouds = field_of_clouds(world);
  for (std::size_t i = 0; i < clouds.particles.count; ++i)
    expected += static_cast<double>(clouds.particles.weight[i]);
  for (const int width : {16, 33, 100, 257, 640}) {
    Frame frame = thin(frame_of(width, width, {clouds}), GetParam());
    frame.camera.pixels_per_length = width / world;
    const double pixel_area = world * world / (width * width);
    EXPECT_NEAR(sum_of_light(draw(frame)) * pixel_area / expected, 1, flux_bound(frame, GetParam()))
        << width << " pixels";
  }
}

TEST_P(Flux, OfASceneIsTheSameAtAnyShift) {
  const DrawnComponent clouds = field_of_clouds(100);
  double expected = 0;
  for (std::size_t i = 0; i < clouds.particles.count; ++i)
    expected += static_cast<double>(clouds.particles.weight[i]);
  for (const double shift : {0.01, 0.25, 0.5, 0.99}) {
    Frame frame = thin(frame_of(100, 100, {clouds}), GetParam());
    frame.camera.center_x += shift;
    frame.camera.center_y -= 0.7 * shift;
    EXPECT_NEAR(sum_of_light(draw(frame)) / expected, 1, flux_bound(frame, GetParam()))
        << "shift " << shift;
  }
}

INSTANTIATE_TEST_SUITE_P(Plans, Flux,
                         testing::Values(LightPlan::emission, LightPlan::proportional,
                                         LightPlan::ordered),
                         [](const auto& info) { return std::string(name(info.param)); });

}  // namespace
}  // namespace splotchcl::test
