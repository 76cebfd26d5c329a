// Parts of the tolerance: those that are tried, stencils', and the refinement filter's.
#include "scene/plan/cloud_sample.h"
#include "scene/plan/grid_filters.h"
#include "scene/plan/stencil.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

Frame frame_of_size(int width, int height) {
  Frame frame;
  frame.width = width;
  frame.height = height;
  return frame;
}

SampledCloud cloud_at(double x, double y, double sigma, double light) {
  SampledCloud cloud;
  cloud.x = x;
  cloud.y = y;
  cloud.sigma = sigma;
  cloud.light = light;
  return cloud;
}

bool shows(const Rectangle& part, double x, double y) {
  return x >= part.x && x < part.x + part.width && y >= part.y && y < part.y + part.height;
}

TEST(LightMap, AddsUpWhatLiesInACell) {
  const std::vector<SampledCloud> clouds(5, cloud_at(100, 60, 20, 0.3));
  EXPECT_NEAR(LightMap(clouds, frame_of_size(200, 150)).brightest(), 1.5, 1e-9);
}

TEST(LightMap, SpreadsNarrowCloudsOverTheirCell) {
  const std::vector<SampledCloud> stars = {cloud_at(100, 60, 0.1, 256)};
  EXPECT_NEAR(LightMap(stars, frame_of_size(200, 150)).brightest(), 1, 1e-9);
}

TEST(LightMap, TakesNothingFromAFewCloudsOfASample) {
  std::vector<SampledCloud> clouds(3, cloud_at(100, 60, 20, 1));
  for (SampledCloud& cloud : clouds)
    cloud.weight = 100;
  EXPECT_EQ(LightMap(clouds, frame_of_size(200, 150)).brightest(), 0);
  clouds.push_back(clouds.front());
  EXPECT_NEAR(LightMap(clouds, frame_of_size(200, 150)).brightest(), 400, 1e-9);
}

TEST(LightMap, LeavesOutWhatLiesBesideThePicture) {
  const std::vector<SampledCloud> clouds(5, cloud_at(-20, 60, 20, 0.3));
  EXPECT_EQ(LightMap(clouds, frame_of_size(200, 150)).brightest(), 0);
}

TEST(LightMap, KnowsWhetherAQuarterOfThePictureIsBright) {
  std::vector<SampledCloud> clouds;
  for (int row = 0; row < 3; ++row)
    clouds.push_back(cloud_at(8, 16 * row + 8, 20, 1));
  const Frame frame = frame_of_size(160, 16);
  EXPECT_EQ(LightMap(clouds, frame).of_bright_quarter(), 0);
  for (int column = 0; column < 4; ++column)
    clouds.push_back(cloud_at(16 * column + 8, 8, 20, 1));
  EXPECT_GE(LightMap(clouds, frame).of_bright_quarter(), 1);
}

TEST(TellingParts, ShowTheBrightestTheMostUnevenAndTheBrightestAtTheEdge) {
  const std::vector<SampledCloud> clouds = {cloud_at(300, 200, 40, 50), cloud_at(100, 200, 2, 8),
                                            cloud_at(420, 500, 40, 3)};
  const Frame frame = frame_of_size(600, 400);
  const std::vector<Rectangle> parts = LightMap(clouds, frame).telling_parts(LightPlan::ordered);
  ASSERT_EQ(parts.size(), 3U);
  EXPECT_TRUE(shows(parts[0], 300, 200));
  EXPECT_TRUE(shows(parts[1], 100, 200));
  EXPECT_TRUE(shows(parts[2], 420, 399));
}

// Where light is deep, or adds up without end, errors of a crowd do not show as those beside it do.
TEST(TellingParts, AreNotWhereLightHidesErrors) {
  std::vector<SampledCloud> clouds(4, cloud_at(104, 200, 20, 50));
  clouds.push_back(cloud_at(400, 200, 20, 3));
  const Frame frame = frame_of_size(600, 400);
  for (const LightPlan light : {LightPlan::emission, LightPlan::proportional}) {
    const Rectangle part = LightMap(clouds, frame).telling_parts(light).front();
    EXPECT_TRUE(shows(part, 104, 200)) << "what is near is drawn";
    EXPECT_FALSE(part.x + 32 <= 104 && 104 < part.x + 48) << "but not in the middle";
  }
}

TEST(TellingParts, AreOneWhereAllIsInOnePlace) {
  const std::vector<SampledCloud> clouds = {cloud_at(300, 399, 5, 50)};
  EXPECT_EQ(LightMap(clouds, frame_of_size(600, 400)).telling_parts(LightPlan::ordered).size(), 1U);
}

TEST(TellingParts, AreNoneOfADarkPicture) {
  EXPECT_TRUE(LightMap({}, frame_of_size(600, 400)).telling_parts(LightPlan::ordered).empty());
}

// Stencils become Gaussians when their grid is blurred, with no more error than
// docs/dev/accuracy.md states.

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

// The weights by which grids are refined err by no more than docs/dev/accuracy.md and the budget of
// coarse grids say.

using Weights = std::array<double, refinement_taps>;

// Pixels before the first of those that a new one is made from.
constexpr int taps_before = static_cast<int>(refinement_taps) / 2 - 1;

double gaussian(double distance, double sigma) {
  return std::exp(-distance * distance / (sigma * sigma));
}

// A row of pixels at half their size.
std::vector<double> refined(const std::vector<double>& pixels, const Weights& weights) {
  constexpr std::size_t before = taps_before, beside = refinement_taps / 2;
  std::vector<double> finer(2 * pixels.size());
  for (std::size_t x = beside; x + beside < pixels.size(); ++x) {
    for (std::size_t k = 0; k < weights.size(); ++k) {
      finer[2 * x + 1] += weights[k] * pixels[x + k - before];
      finer[2 * x] += weights[k] * pixels[x + before - k];
    }
  }
  return finer;
}

// After six refinements one after the other, of one axis.
double largest_error_of_all(const Weights& weights, double sigma, double center) {
  constexpr std::size_t count = 96;
  std::vector<double> pixels(count);
  for (std::size_t x = 0; x < count; ++x)
    pixels[x] = gaussian(static_cast<double>(x) - count / 2 - center, sigma);
  double largest = 0;
  for (int level = 1; level <= 6; ++level) {
    pixels = refined(pixels, weights);
    const double size = std::ldexp(1.0, -level);
    for (std::size_t x = 0; x < pixels.size(); ++x) {
      const double place = (static_cast<double>(x) + 0.5) * size - 0.5 - count / 2;
      if (std::abs(place) < 15)
        largest = std::max(largest, std::abs(pixels[x] - gaussian(place - center, sigma)));
    }
  }
  return largest;
}

double largest_error_of_all(const Weights& weights, double sigma) {
  double largest = 0;
  for (double center = -0.5; center <= 0.5; center += 0.1)
    largest = std::max(largest, largest_error_of_all(weights, sigma, center));
  return largest;
}

TEST(RefinementFilter, KeepsEvenLightEven) {
  for (const double error : {6e-4, 1e-4, 1e-5, 1e-6, 1e-7}) {
    double sum = 0;
    for (const double weight : choose_refinement(error).weights)
      sum += weight;
    EXPECT_NEAR(sum, 1, 2e-9) << error;
  }
}

// What least squares change are tenth differences.
TEST(RefinementFilter, IsExactForPolynomialsOfDegreeNine) {
  const Weights weights = choose_refinement(1e-4).weights;
  for (int degree = 0; degree <= 9; ++degree) {
    double interpolated = 0;
    for (std::size_t k = 0; k < weights.size(); ++k)
      interpolated += weights[k] * std::pow((static_cast<double>(k) - taps_before) / 8, degree);
    EXPECT_NEAR(interpolated, std::pow(0.25 / 8, degree), 1e-12) << degree;
  }
}

TEST(RefinementFilter, KeepsTheErrorOfAllRefinementsOverBothAxesAtTheSmallestWidth) {
  for (const double error : {1e-3, 6e-4, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6, 1e-6, 1e-7, 1e-8}) {
    const RefinementFilter filter = choose_refinement(error);
    EXPECT_LT(2 * largest_error_of_all(filter.weights, filter.smallest_sigma), error);
  }
}

// The next width of the table is at most a twentieth wider, and errors fall as sigma^-12.
TEST(RefinementFilter, CarriesSplatsNotMuchWiderThanTheErrorNeeds) {
  for (const double error : {6e-4, 1e-4, 1e-5, 2e-6}) {
    const RefinementFilter filter = choose_refinement(error);
    EXPECT_GT(2 * largest_error_of_all(filter.weights, 0.92 * filter.smallest_sigma), error);
  }
}

TEST(RefinementFilter, BestOneErrsByNoMoreThanStatedInAllRefinementsTogether) {
  for (const double sigma : {1.9, 2.0, 2.11, 2.2, 2.35, 2.5, 2.8, 3.1, 3.5, 4.0}) {
    const RefinementOfSigma best = best_refinement(sigma);
    EXPECT_LT(2 * largest_error_of_all(best.filter.weights, sigma), best.error) << sigma;
  }
}

// GridPyramid::wider_for: a splat of peak P is P^(1/8) times wider.
TEST(RefinementFilter, ErrsByNoMoreForBrightSplatsThatAreWiderByTheEighthRoot) {
  for (const double sigma : {1.9, 2.11, 2.5, 2.8}) {
    const RefinementOfSigma best = best_refinement(sigma);
    for (double wider = 1; wider <= 4; wider *= 1.1892) {
      EXPECT_LT(2 * std::pow(wider, 8) * largest_error_of_all(best.filter.weights, wider * sigma),
                1.05 * best.error)
          << sigma << " " << wider;
    }
  }
}

}  // namespace
}  // namespace splotchcl::test
