#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "reference/frames.h"
#include "splotchcl/image.h"
#include "splotchcl/reference.h"
#include "splotchcl/renderer.h"

namespace splotchcl::test {

// Uniform numbers that are the same with every standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform(double low = 0, double high = 1) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  double logarithmic(double low, double high) { return low * std::pow(high / low, uniform()); }

 private:
  std::mt19937_64 engine_;
};

inline Palette two_colors() {
  Palette palette;
  palette.emission = {Rgb{1.0f, 0.3f, 0.05f}, Rgb{0.2f, 0.6f, 1.0f}};
  return palette;
}

struct CloudSetup {
  int count = 500;
  int width = 100, height = 70;
  double sigma_low = 0.05, sigma_high = 30;
  double column_low = 0.01, column_high = 1;
  std::uint64_t seed = 1;
};

// Clouds all over the picture and a little beyond, in random colours.
inline DrawnComponent random_clouds(const CloudSetup& setup) {
  Random random(setup.seed);
  std::vector<Cloud> clouds;
  std::vector<float> colors;
  for (int i = 0; i < setup.count; ++i) {
    Cloud cloud;
    cloud.x = random.uniform(-0.6, 0.6) * setup.width;
    cloud.y = random.uniform(-0.6, 0.6) * setup.height;
    cloud.z = random.uniform(1, 100);
    cloud.sigma = random.logarithmic(setup.sigma_low, setup.sigma_high);
    cloud.column = random.logarithmic(setup.column_low, setup.column_high);
    clouds.push_back(cloud);
    colors.push_back(static_cast<float>(random.uniform()));
  }
  DrawnComponent component = component_of(clouds, two_colors());
  component.particles.color = Column::owning(colors);
  return component;
}

// Of errors, where one that is not a number is larger than any.
inline double larger(double largest, double error) {
  return std::isfinite(error) ? std::max(largest, error) : 1e300;
}

// The largest |frame - oracle| / max(1, |oracle|) over pixels and colours: what
// `tolerance` bounds.
inline double largest_error(const Image& image, const ReferenceImage& exact) {
  double largest = 0;
  for (std::size_t i = 0; i < exact.pixels.size(); ++i) {
    if (i % 4 == 3) continue;
    const double error = std::abs(static_cast<double>(image.pixels[i]) - exact.pixels[i]);
    const double relative = error / std::max(1.0, std::abs(exact.pixels[i]));
    largest = larger(largest, relative);
  }
  return largest;
}

inline double largest_value(const ReferenceImage& exact) {
  return *std::max_element(exact.pixels.begin(), exact.pixels.end());
}

}  // namespace splotchcl::test
