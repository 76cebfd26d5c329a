#include "scene/plan/grid_pyramid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/plan/blur_filter.h"
#include "scene/plan/refinement_filter.h"

namespace splotchcl {
namespace {

// A pixel reads coarse pixels from five left of its own to five right: with ten pixels of
// guard, 10 / 2 + 5, every pixel that refining reads exists. Even, so that a pixel's index
// tells on which side of its coarse pixel's center it lies.
constexpr int guard_pixels = 10;

// Below this a coarse grid costs more to refine than it saves.
constexpr int smallest_coarse_side = 16;
constexpr int most_levels = 12;

int ceil_divide(int value, int by) {
  return (value + by - 1) / by;
}

// Guard pixels whose values a blur needs beyond those that refining reads.
int blurred_guard(const GridPyramid& pyramid) {
  const auto reach = [&pyramid](double sigma2) {
    return static_cast<int>(blur_weights(sigma2, pyramid.blur_error).size() / 2);
  };
  const int reached = reach(pyramid.blur[1] - pyramid.blur[0]) + reach(pyramid.blur[0]);
  return guard_pixels + reached + reached % 2;
}

// Where the scene cuts the kernel, a coarse grid blurs the step at the disc's edge, which
// is exp(-cut^2) of the peak. Where many such edges cross, their errors have either sign:
// at optical depth 1 there are 1 / peak splats, and the sum errs by about half the step
// times sqrt(peak). An estimate, not a bound (docs/accuracy.md).
double brightest_coarse_peak(const KernelSettings& kernel, double error) {
  if (!kernel.cut) return std::numeric_limits<float>::max();
  const double step = std::exp(-*kernel.cut * *kernel.cut);
  const double root = 2 * error / step;
  // Nor must the edges of a few copies of one particle, which lie upon one another.
  constexpr double copies = 50;
  return std::min(root * root, error / (copies * step));
}

// Splats of sigma >= smallest_sigma are drawn narrower, where the blur that makes up for it has not
// too many weights, as it has for tolerances of some 1e-6.
void choose_blur(double smallest_sigma, GridPyramid& pyramid) {
  pyramid.blur[0] = largest_blur(smallest_sigma, pyramid.blur_error);
  pyramid.blur[1] = largest_blur(std::sqrt(2.0) * smallest_sigma, pyramid.blur_error);
  for (const double sigma2 : {pyramid.blur[0], pyramid.blur[1] - pyramid.blur[0]}) {
    if (blur_weights(sigma2, pyramid.blur_error).size() > most_blur_weights)
      pyramid.is_blurred = false;
  }
}

// How a relative error of the splats on coarse grids is spent: a fifth on the blur, which
// needs the least of it, the rest on the interpolation.
void choose_filters(const KernelSettings& kernel, float mean_sigma, double error,
                    GridPyramid& pyramid) {
  constexpr double blur_part = 0.2;
  pyramid.refinement = choose_refinement((1 - blur_part) * error);
  pyramid.coarse_peak = static_cast<float>(brightest_coarse_peak(kernel, error));
  double smallest_sigma =
      std::max(pyramid.refinement.smallest_sigma, static_cast<double>(mean_sigma));
  // A blur would carry light over the edge of a cloud that is cut.
  pyramid.is_blurred = !kernel.cut;
  if (pyramid.is_blurred) {
    pyramid.blur_error = blur_part * error;
    smallest_sigma = std::max(smallest_sigma, smallest_blurred_sigma(pyramid.blur_error));
    choose_blur(smallest_sigma, pyramid);
  }
  pyramid.coarse_sigma = static_cast<float>(smallest_sigma);
}

void append_coarse_grids(const Frame& frame, GridPyramid& pyramid) {
  const int guard = pyramid.is_blurred ? blurred_guard(pyramid) : guard_pixels;
  for (int level = 1; level < most_levels; ++level) {
    const int width = ceil_divide(frame.width, 1 << level);
    const int height = ceil_divide(frame.height, 1 << level);
    if (std::max(width, height) < smallest_coarse_side) break;
    pyramid.level_grids.push_back(static_cast<int>(pyramid.grids.size()));
    const PictureGrid grid = {level, width + 2 * guard, height + 2 * guard, guard};
    pyramid.grids.insert(pyramid.grids.end(), pyramid.is_blurred ? 2 : 1, grid);
  }
}

}  // namespace

GridPyramid make_single_grid(const Frame& frame) {
  GridPyramid pyramid;
  pyramid.grids = {{0, frame.width, frame.height, 0}};
  pyramid.level_grids = {0};
  pyramid.coarse_sigma = std::numeric_limits<float>::max();
  return pyramid;
}

GridPyramid make_pyramid(const Frame& frame, float mean_sigma, double error) {
  GridPyramid pyramid = make_single_grid(frame);
  choose_filters(frame.kernel, mean_sigma, error, pyramid);
  append_coarse_grids(frame, pyramid);
  return pyramid;
}

}  // namespace splotchcl
