// One cloud, against the formula.
#include "reference/frames.h"
#include "splotchcl/reference.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

DrawnComponent emitting(const std::vector<Cloud>& clouds) {
  DrawnComponent component = component_of(clouds, one_color(1, 0.5f, 0.25f));
  component.absorption.kind = Absorption::Kind::none;
  return component;
}

reference::Splat splat_at(double x, double y, double sigma) {
  reference::Splat splat;
  splat.x = x;
  splat.y = y;
  splat.sigma = sigma;
  splat.weight = 1;
  return splat;
}

double flux(const reference::Splat& splat, const KernelSettings& kernel, int radius) {
  const int x0 = static_cast<int>(std::floor(splat.x));
  const int y0 = static_cast<int>(std::floor(splat.y));
  double sum = 0;
  for (int y = y0 - radius; y <= y0 + radius; ++y) {
    double row = 0;
    for (int x = x0 - radius; x <= x0 + radius; ++x)
      row += shape(splat, x, y, kernel);
    sum += row;
  }
  return sum;
}

TEST(Gaussian, PixelMeanKeepsTheFluxAtAnyWidthAndShift) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> shift(-2, 2);
  for (const double sigma : {1e-5, 1e-4, 1e-2, 0.3, 1.0, 2.7, 10.0, 300.0}) {
    const double x = shift(random), y = shift(random);
    // At 6.5 sigma exp(-42) of the light is outside.
    const int radius = static_cast<int>(std::ceil(6.5 * sigma)) + 1;
    const double sum = flux(splat_at(x, y, sigma), KernelSettings{}, radius);
    // Rounding: two sums of up to 4000 terms, 1.1e-16 a term, and at 300 pixels 2e-14 for
    // the differences of erf over 1/300, once per axis.
    EXPECT_NEAR(sum / (pi * sigma * sigma), 1, 1e-12) << "sigma " << sigma;
  }
}

TEST(Gaussian, OnACornerOfPixelsIsSharedByFour) {
  const reference::Splat splat = splat_at(3, 5, 1e-5);
  const double quarter = pi * 1e-10 / 4;
  EXPECT_NEAR(shape(splat, 2, 4, {}) / quarter, 1, 1e-12);
  EXPECT_NEAR(shape(splat, 3, 4, {}) / quarter, 1, 1e-12);
  EXPECT_NEAR(shape(splat, 2, 5, {}) / quarter, 1, 1e-12);
  EXPECT_NEAR(shape(splat, 3, 5, {}) / quarter, 1, 1e-12);
}

TEST(Gaussian, PixelMeanFarOutKeepsItsDigits) {
  // A pixel 20 sigma away on the right and its mirror image on the left; the value is
  // the integral of exp(-t^2) near t = 20, by Simpson's rule on a fine grid.
  const double sigma = 0.5;
  const auto integral = [](double a, double b) {
    const int steps = 20000;
    const double step = (b - a) / steps;
    double sum = std::exp(-a * a) + std::exp(-b * b);
    for (int i = 1; i < steps; ++i) {
      const double t = a + i * step;
      sum += (i % 2 == 1 ? 4 : 2) * std::exp(-t * t);
    }
    return sum * step / 3;
  };
  const double expected_x = sigma * integral(20, 22);
  const double expected_y = sigma * integral(-1, 1);
  const reference::Splat splat = splat_at(0, 0.5, sigma);
  EXPECT_NEAR(shape(splat, 10, 0, {}) / (expected_x * expected_y), 1, 1e-9);
  EXPECT_NEAR(shape(splat, -11, 0, {}) / (expected_x * expected_y), 1, 1e-9);
}

TEST(Gaussian, CenterSamplingIsTheFormulaAtThePixelCenter) {
  KernelSettings kernel;
  kernel.sampling = Sampling::center;
  const reference::Splat splat = splat_at(4.2, 3.9, 1.7);
  const double dx = 6.5 - 4.2, dy = 2.5 - 3.9;
  EXPECT_NEAR(shape(splat, 6, 2, kernel), std::exp(-(dx * dx + dy * dy) / (1.7 * 1.7)), 1e-15);
}

TEST(Gaussian, PixelMeanTendsToTheCenterValueForWideClouds) {
  KernelSettings center;
  center.sampling = Sampling::center;
  const reference::Splat splat = splat_at(0.3, -0.2, 300);
  // The mean differs by the Laplacian / 24, at most 4 / (24 sigma^2) of the peak.
  EXPECT_NEAR(shape(splat, 40, -70, {}), shape(splat, 40, -70, center), 4.0 / (24 * 300 * 300));
}

TEST(Gaussian, PeakOfAnEmittingCloudIsBrightnessTimesColumnTimesColor) {
  DrawnComponent component = emitting({Cloud{0.5, 0.5, 1, 3, 0.8}});
  component.brightness = 2;
  component.reference_column = 4;
  Frame frame = frame_of(32, 32, {component});
  frame.kernel.sampling = Sampling::center;
  const ReferenceImage image = reference::render(frame);
  const double* peak = &image.pixels[4 * (16 * 32 + 16)];
  // The mass is stored in single precision.
  EXPECT_NEAR(peak[0], 0.4, 1e-7);
  EXPECT_NEAR(peak[1], 0.2, 1e-7);
  EXPECT_NEAR(peak[2], 0.1, 1e-7);
  EXPECT_EQ(peak[3], 0);
}

TEST(Gaussian, FluxOfThePictureDoesNotDependOnSubpixelShiftsOrSize) {
  for (const double sigma : {1e-4, 0.05, 0.8, 4.0}) {
    for (const double shift : {0.0, 0.125, 0.5, 0.77}) {
      const double column = 1 / (pi * sigma * sigma);
      const Frame frame = frame_of(96, 96, {emitting({Cloud{shift, -shift, 1, sigma, column}})});
      const ReferenceImage image = reference::render(frame);
      double sum = 0;
      for (std::size_t i = 0; i < image.pixels.size(); i += 4)
        sum += image.pixels[i];
      // Relative to sigma and mass as stored in single precision.
      EXPECT_NEAR(sum, 1, 3e-7) << "sigma " << sigma << ", shift " << shift;
    }
  }
}

TEST(Cut, EndsTheCloudAtPixelCentersBeyondIt) {
  KernelSettings kernel;
  kernel.cut = 2;
  for (const Sampling sampling : {Sampling::mean, Sampling::center}) {
    kernel.sampling = sampling;
    const reference::Splat splat = splat_at(0.5, 0.5, 5);
    EXPECT_GT(shape(splat, 10, 0, kernel), 0);
    EXPECT_EQ(shape(splat, 11, 0, kernel), 0);
    EXPECT_GT(shape(splat, 6, 8, kernel), 0);
    EXPECT_EQ(shape(splat, 7, 8, kernel), 0);
  }
}

TEST(Cut, LeavesATinyCloudItsOwnPixelWithPixelMeansOnly) {
  KernelSettings kernel;
  kernel.cut = 2;
  const reference::Splat splat = splat_at(0.1, 0.1, 0.01);
  EXPECT_NEAR(shape(splat, 0, 0, kernel), pi * 1e-4, 1e-16);
  kernel.sampling = Sampling::center;
  EXPECT_EQ(shape(splat, 0, 0, kernel), 0);
}

TEST(MinimumRadius, WidensSmallCloudsAndLowersTheirWeight) {
  Frame frame = frame_of(8, 8, {emitting({Cloud{0, 0, 1, 3, 1}})});
  frame.kernel.min_radius_pixels = 4;
  const auto splats = reference::project(frame);
  ASSERT_EQ(splats.size(), 1u);
  EXPECT_NEAR(splats[0].sigma, 5, 1e-12);
  EXPECT_NEAR(splats[0].weight, 0.6, 1e-6);
}

// sigma 3 becomes 5, so that the area grows 25 / 9 times.
TEST(Footprint, WidensCloudsAndKeepsTheirLight) {
  Frame frame = frame_of(8, 8, {emitting({Cloud{0, 0, 1, 3, 1}})});
  frame.kernel.footprint_pixels = std::sqrt(8.0);
  const auto splats = reference::project(frame);
  ASSERT_EQ(splats.size(), 1u);
  EXPECT_NEAR(splats[0].sigma, 5, 1e-12);
  EXPECT_NEAR(splats[0].weight, 0.36, 1e-6);
}

}  // namespace
}  // namespace splotchcl::test
