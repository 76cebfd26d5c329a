// Stencils become Gaussians when their grid is blurred, with no more error than
// docs/dev/accuracy.md states.
#include "scene/plan/stencil.h"

#include "scene/plan/blur_filter.h"
#include "testing.h"

namespace splotchcl {
namespace {

constexpr double end_of_blur = 2e-5;
const double next_grid = std::exp2(0.25);

struct BlurredStencil {
  std::vector<float> blur;
  Stencil stencil;
};

BlurredStencil stencil_from(double smallest) {
  BlurredStencil made;
  made.blur = blur_weights(blur_of_stencil(smallest), end_of_blur);
  made.stencil = make_stencil(smallest, smallest * next_grid, made.blur);
  return made;
}

// By how much a pixel at x, from the one before the center, differs from the Gaussian when all
// pixels are blurred.
double error_at(const BlurredStencil& made, int x, double place, double sigma) {
  const auto weights = stencil_weights(made.stencil, place, sigma);
  const int half_width = static_cast<int>(made.blur.size() / 2);
  double value = 0;
  for (std::size_t k = 0; k < weights.size(); ++k) {
    const int from_pixel = x - (static_cast<int>(k) - 3);
    if (std::abs(from_pixel) <= half_width)
      value += weights[k] *
               static_cast<double>(made.blur[static_cast<std::size_t>(from_pixel + half_width)]);
  }
  return std::abs(value - std::exp(-(x - place) * (x - place) / (sigma * sigma)));
}

double largest_error(const BlurredStencil& made, double smallest) {
  double largest = 0;
  for (double place = 0; place <= 1; place += 1.0 / 37) {
    for (double part = 0; part <= 1; part += 1.0 / 11) {
      const double sigma = smallest * std::pow(next_grid, part);
      for (int x = -30; x <= 30; ++x)
        largest = std::max(largest, error_at(made, x, place, sigma));
    }
  }
  return largest;
}

struct StatedError {
  double smallest, error;
};

class Stencils : public testing::TestWithParam<StatedError> {};

TEST_P(Stencils, ErrAsStated) {
  const BlurredStencil made = stencil_from(GetParam().smallest);
  EXPECT_LE(largest_error(made, GetParam().smallest), GetParam().error);
}

// What the plan relies on is looked for at fewer places.
TEST_P(Stencils, KnowTheirErrorToATenth) {
  const BlurredStencil made = stencil_from(GetParam().smallest);
  EXPECT_LE(largest_error(made, GetParam().smallest), 1.1 * made.stencil.error);
}

TEST_P(Stencils, KeepTheLightOfASplat) {
  const double smallest = GetParam().smallest;
  const BlurredStencil made = stencil_from(smallest);
  for (const double sigma : {smallest, 1.1 * smallest, smallest * next_grid}) {
    for (const double place : {0.0, 0.3, 0.5, 1.0}) {
      double light = 0;
      for (const double weight : stencil_weights(made.stencil, place, sigma))
        light += weight;
      EXPECT_NEAR(light / (sigma * std::sqrt(std::acos(-1.0))), 1, 1e-4);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Widths, Stencils,
                         testing::Values(StatedError{1.9, 2.8e-4}, StatedError{2, 1.75e-4},
                                         StatedError{2.11, 1.5e-4}, StatedError{2.5, 1.0e-4},
                                         StatedError{2.98, 8.0e-5}, StatedError{3.55, 8.0e-5},
                                         StatedError{4.2, 9.0e-5}),
                         [](const auto& info) {
                           return "From" +
                                  std::to_string(static_cast<int>(100 * info.param.smallest));
                         });

// Roundings of single precision count times the square of the largest weight.
TEST(Stencil, HasNoLargeWeights) {
  for (const double smallest : {2.11, 2.98, 4.2}) {
    const BlurredStencil made = stencil_from(smallest);
    for (const double place : {0.0, 0.5, 1.0}) {
      for (const double weight : stencil_weights(made.stencil, place, smallest))
        EXPECT_LT(std::abs(weight), 40);
    }
  }
}

}  // namespace
}  // namespace splotchcl
