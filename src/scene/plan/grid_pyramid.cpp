#include "scene/plan/grid_pyramid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/ceil_divide.h"
#include "scene/plan/grid_filters.h"
#include "scene/plan/stencil.h"

namespace splotchcl {
namespace {

// Below this a coarse grid costs more to refine than it saves.
constexpr int smallest_coarse_side = 16;
constexpr int most_levels = 12;
constexpr std::size_t most_grids = 32;  // bits of used_grids (records.h)

// Stencils do not come closer than that (docs/dev/accuracy.md).
constexpr double least_stencil_error = 8e-5;

// Where the scene cuts the kernel, a coarse grid blurs the step at the disc's edge, which
// is exp(-cut^2) of the peak. Where many such edges cross, their errors have either sign:
// at optical depth 1 there are 1 / peak splats, and the sum errs by about half the step
// times sqrt(peak). An estimate, not a bound (docs/dev/accuracy.md).
double brightest_coarse_peak(const KernelSettings& kernel, double error) {
  if (!kernel.cut) return std::numeric_limits<float>::max();
  const double step = std::exp(-*kernel.cut * *kernel.cut);
  const double root = 2 * error / step;
  // Nor must the edges of a few copies of one particle, which lie upon one another.
  constexpr double copies = 50;
  return std::min(root * root, error / (copies * step));
}

// Splats of sigma >= smallest_sigma are drawn narrower, where the blur that makes up for it has not
// too many weights. An octave of widths is shared out among so many grids, or fewer, whose blurs
// are less wide.
std::vector<double> choose_blurs(double smallest_sigma, double error, int count) {
  std::vector<double> blurs;
  for (int i = 0; i < count; ++i) {
    const double smallest = std::exp2(static_cast<double>(i) / count) * smallest_sigma;
    blurs.push_back(largest_blur(smallest, error));
  }
  const int widest = 2 * blur_reach(blurs.back(), error) + 1;
  if (widest <= most_blur_weights) return blurs;
  return count > 1 ? choose_blurs(smallest_sigma, error, count / 2) : std::vector<double>();
}

// Splats that are taken as means stay on the picture's own grid: how wide wider ones are on one of
// this level, in its pixels.
double end_of_means(const PyramidNeeds& needs, int level) {
  return std::ldexp(static_cast<double>(needs.mean_sigma), -level);
}

// A narrower Gaussian for each blur, or one grid without: a fifth of the error is spent on the
// blur, which needs the least of it, the rest on the interpolation.
void choose_narrower_splats(const KernelSettings& kernel, const PyramidNeeds& needs,
                            GridPyramid& pyramid) {
  constexpr double blur_part = 0.2;
  pyramid.refinement = choose_refinement((1 - blur_part) * needs.error);
  double smallest_sigma = std::max(pyramid.refinement.smallest_sigma, end_of_means(needs, 1));
  // A blur would carry light over the edge of a cloud that is cut.
  if (!kernel.cut) {
    pyramid.blur_error = blur_part * needs.error;
    smallest_sigma = std::max(smallest_sigma, smallest_blurred_sigma(pyramid.blur_error));
    pyramid.blurs = choose_blurs(smallest_sigma, pyramid.blur_error, needs.blurs_of_level);
  }
  pyramid.coarse_sigma = static_cast<float>(smallest_sigma);
}

// Stencils of splats from smallest_sigma on, and the blurs that they go with.
void make_stencils(double smallest_sigma, int count, GridPyramid& pyramid) {
  pyramid.blurs.clear();
  pyramid.stencils.clear();
  for (int i = 0; i < count; ++i) {
    const double smallest = std::exp2(static_cast<double>(i) / count) * smallest_sigma;
    const double largest = std::exp2(static_cast<double>(i + 1) / count) * smallest_sigma;
    pyramid.blurs.push_back(blur_of_stencil(smallest));
    pyramid.stencils.push_back(
        make_stencil(smallest, largest, blur_weights(pyramid.blurs.back(), pyramid.blur_error)));
  }
}

double error_of_stencils(const GridPyramid& pyramid) {
  double error = 0;
  for (const Stencil& stencil : pyramid.stencils)
    error = std::max(error, stencil.error);
  constexpr int axes = 2;
  return axes * error;
}

// From the narrowest splats on for which interpolation and stencils together keep the error, and
// which need no means. False where none do.
bool choose_stencils(const PyramidNeeds& needs, int grids_of_level, GridPyramid& pyramid) {
  constexpr double end_of_blurs = 2e-5;
  pyramid.blur_error = std::min(end_of_blurs, 0.1 * needs.error);
  for (const double smallest : {1.9, 1.95, 2.0, 2.05, 2.11, 2.2, 2.3, 2.5, 2.8}) {
    const double sigma = std::max(smallest, end_of_means(needs, needs.first_level));
    const RefinementOfSigma refinement = best_refinement(sigma);
    const double left = needs.error - refinement.error;
    if (left < least_stencil_error) continue;
    make_stencils(sigma, grids_of_level, pyramid);
    if (error_of_stencils(pyramid) > left) continue;
    pyramid.refinement = refinement.filter;
    pyramid.coarse_sigma = static_cast<float>(sigma);
    pyramid.first_level = needs.first_level;
    return true;
  }
  pyramid.stencils.clear();
  pyramid.blurs.clear();
  return false;
}

// How a relative error of the splats on coarse grids is spent.
void choose_filters(const Frame& frame, const PyramidNeeds& needs, GridPyramid& pyramid) {
  const KernelSettings& kernel = frame.kernel;
  pyramid.coarse_peak = static_cast<float>(brightest_coarse_peak(kernel, needs.error));
  if (needs.stencils && choose_stencils(needs, most_blurs(frame), pyramid)) return;
  choose_narrower_splats(kernel, needs, pyramid);
}

bool has_level(const Frame& frame, int level) {
  return level < most_levels &&
         ceil_divide(std::max(frame.width, frame.height), 1 << level) >= smallest_coarse_side;
}

void append_coarse_grids(const Frame& frame, GridPyramid& pyramid) {
  // A blur needs values beyond those that refining reads.
  const int reach = reach_of_blurs(pyramid);
  // With twice of what refining reaches, of which a half is a finer grid's, every pixel that it
  // reads exists. Even, so that a pixel's index tells on which side of its coarse pixel's center it
  // lies.
  const int guard = 2 * RefinementFilter::reach() + reach + reach % 2;
  for (int level = pyramid.first_level; has_level(frame, level); ++level) {
    if (pyramid.grids.size() + pyramid.grids_of_level() > most_grids) break;
    const int width = ceil_divide(frame.width, 1 << level);
    const int height = ceil_divide(frame.height, 1 << level);
    if (level > 0) pyramid.level_grids.push_back(static_cast<int>(pyramid.grids.size()));
    const PictureGrid grid = {level, width + 2 * guard, height + 2 * guard, guard};
    pyramid.grids.insert(pyramid.grids.end(), pyramid.grids_of_level(), grid);
  }
}

}  // namespace

int reach_of_blurs(const GridPyramid& pyramid) {
  return pyramid.is_blurred() ? blur_reach(pyramid.blurs.back(), pyramid.blur_error) : 0;
}

int most_blurs(const Frame& frame) {
  constexpr std::size_t most = most_grids_of_level;
  std::size_t coarse_levels = 0;
  while (has_level(frame, static_cast<int>(coarse_levels) + 1))
    ++coarse_levels;
  return static_cast<int>(1 + most * coarse_levels <= most_grids ? most : most / 2);
}

// Errors of the interpolation fall as sigma^-8 at least. A narrower Gaussian that is blurred has to
// be wider than the blur is, which may be as wide as the narrowest stencil.
double GridPyramid::wider_for(double peak) const {
  const double next_grid = std::exp2(1 / static_cast<double>(grids_of_level()));
  return std::max(std::pow(peak, 0.125), has_stencils() ? next_grid : 1.0);
}

double GridPyramid::over_least_width(double sigma, double peak) const {
  if (grids.size() < 2 || peak > static_cast<double>(coarse_peak)) return 0;
  return sigma / (static_cast<double>(coarse_sigma) * (peak > 1 ? wider_for(peak) : 1));
}

GridPyramid make_single_grid(const Frame& frame) {
  GridPyramid pyramid;
  pyramid.grids = {{0, frame.width, frame.height, 0}};
  pyramid.level_grids = {0};
  pyramid.coarse_sigma = std::numeric_limits<float>::max();
  return pyramid;
}

GridPyramid make_pyramid(const Frame& frame, const PyramidNeeds& needs) {
  GridPyramid pyramid = make_single_grid(frame);
  choose_filters(frame, needs, pyramid);
  append_coarse_grids(frame, pyramid);
  return pyramid;
}

}  // namespace splotchcl
