#include "device/frame_layout.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>
#include <string>

#include "device/blur_filter.h"
namespace splotchcl {
namespace {

// A pixel reads coarse pixels from five left of its own to five right: with ten pixels of
// guard, 10 / 2 + 5, every pixel that refining reads exists. Even, so that a pixel's index
// tells on which side of its coarse pixel's centre it lies.
constexpr int guard_pixels = 10;

// Below this a coarse grid costs more to refine than it saves.
constexpr int smallest_coarse_side = 16;
constexpr int most_levels = 12;

int ceil_divide(int value, int by) {
  return (value + by - 1) / by;
}

void append_grid(FrameLayout& layout, int width, int height, int guard, float mean_sigma) {
  kernel::Grid grid{};
  grid.width = width + 2 * guard;
  grid.height = height + 2 * guard;
  grid.guard = guard;
  grid.mean_sigma = mean_sigma;
  grid.tiles_x = ceil_divide(grid.width, static_cast<int>(layout.tile_width));
  grid.tiles_y = ceil_divide(grid.height, static_cast<int>(layout.tile_height));
  grid.first_tile = layout.tile_count;
  grid.stride = static_cast<std::uint32_t>(grid.tiles_x) * layout.tile_width;
  grid.plane_size = grid.stride * static_cast<std::uint32_t>(grid.tiles_y) * layout.tile_height;
  grid.first_float_low = static_cast<std::uint32_t>(layout.plane_floats);
  grid.first_float_high = static_cast<std::uint32_t>(layout.plane_floats >> 32);
  layout.grids.push_back(grid);
  layout.tile_count += static_cast<std::uint32_t>(grid.tiles_x * grid.tiles_y);
  layout.plane_floats += std::uint64_t{layout.planes} * grid.plane_size;
}

// Coarse grids are for round splats.
bool may_use_coarse_grids(const Plan& plan, const FrameLayout& layout) {
  return !layout.ellipses && plan.coarse_share > 0;
}

// Guard pixels whose values a blur needs beyond those that refining reads.
int blurred_guard(const FrameLayout& layout) {
  const auto reach = [&layout](double sigma2) {
    return static_cast<int>(blur_weights(sigma2, layout.blur_error).size() / 2);
  };
  const int reached = reach(layout.blur[1] - layout.blur[0]) + reach(layout.blur[0]);
  return guard_pixels + reached + reached % 2;
}

// The grids of a sum: from the picture's own pixels to ever coarser ones.
void append_coarse_grids(FrameLayout& layout, const Rectangle& crop) {
  const int guard = layout.bands ? blurred_guard(layout) : guard_pixels;
  for (int level = 1; level < most_levels; ++level) {
    const int width = ceil_divide(crop.width, 1 << level);
    const int height = ceil_divide(crop.height, 1 << level);
    if (std::max(width, height) < smallest_coarse_side) break;
    layout.level_grids.push_back(static_cast<std::uint32_t>(layout.grids.size()));
    // Compositing there knows centre values only: coarse_sigma sees to it.
    append_grid(layout, width, height, guard, 0);
    if (layout.bands) append_grid(layout, width, height, guard, 0);
  }
}

// Where the scene cuts the kernel, a coarse grid blurs the step at the disc's edge, which
// is exp(-cut^2) of the peak. Where many such edges cross, their errors have either sign:
// at optical depth 1 there are 1 / peak splats, and the sum errs by about half the step
// times sqrt(peak). An estimate, not a bound (docs/accuracy.md).
double brightest_coarse_peak(const Frame& frame, double error) {
  if (!frame.kernel.cut) return std::numeric_limits<float>::max();
  const double step = std::exp(-*frame.kernel.cut * *frame.kernel.cut);
  const double root = 2 * error / step;
  // One edge alone must not show either.
  return std::min(root * root, error / step);
}

// The light that reaches a pixel from beyond the splats' squares comes from neighbours that
// may be brighter than the pixel itself: measured up to 2.3 times what even light would
// give on the cosmological box of docs/accuracy.md. Half of it is put back, so 1.5 covers it.
constexpr double uneven_light = 1.5;

// The half side, in sigma, of the square outside which a splat has this fraction of its
// light: 1 - erf(k)^2 < 2 erfc(k) = loss.
double extent_of_loss(double loss) {
  double low = 0, high = 8;
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    (2 * std::erfc(middle) > loss ? low : high) = middle;
  }
  return high;
}

bool has_own_colors(const DrawnComponent& component) {
  return !component.particles.color_vector.is_absent();
}

// Between two knots of both palettes E and A are linear, so E / A is largest at a knot.
double brightest_quotient(const Palette& palette) {
  double largest = 0;
  for (const std::vector<Rgb>* knots : {&palette.emission, &palette.absorption}) {
    for (std::size_t k = 0; k < knots->size(); ++k) {
      const double place =
          static_cast<double>(k) / static_cast<double>(std::max<std::size_t>(knots->size() - 1, 1));
      const auto emission = sample_knots(palette.emission, place);
      const auto absorption = sample_knots(palette.absorption, place);
      for (std::size_t c = 0; c < 3; ++c) {
        if (emission[c] > 0) largest = std::max(largest, emission[c] / absorption[c]);
      }
    }
  }
  return largest;
}

// Largest E / A of the component.
double brightest_source(const DrawnComponent& component) {
  using Kind = Absorption::Kind;
  if (component.absorption.kind == Kind::none) return std::numeric_limits<double>::infinity();
  if (component.absorption.kind == Kind::gray) return 1;
  const double factor = component.absorption.kind == Kind::factor
                            ? component.brightness / component.absorption.factor
                            : 1;
  if (!component.palette.has_own_absorption()) return factor;
  // Colours of the particles' own have no bound that is known without reading them all.
  if (has_own_colors(component)) return std::numeric_limits<double>::infinity();
  return factor * brightest_quotient(component.palette);
}

double brightest_background(const Frame& frame) {
  if (!frame.background_image) {
    return *std::max_element(frame.background.begin(), frame.background.end());
  }
  float brightest = 0;
  const std::vector<float>& pixels = frame.background_image->pixels;
  for (std::size_t i = 0; i < pixels.size(); i += 4) {
    brightest = std::max({brightest, pixels[i], pixels[i + 1], pixels[i + 2]});
  }
  return static_cast<double>(brightest);
}

// What a relative error of every splat does to the picture, relative to max(1, I). Light
// that nothing absorbs errs by as much. Otherwise I = q (1 - exp(-x)) for source q and
// depth x, and with x off by a part e the error is e q x exp(-x): at most q / e times
// exp(-1), and never more than e I.
double response(const Frame& frame, double background) {
  constexpr double depth_to_light = 0.36787944117144233;  // the maximum of x exp(-x)
  double brightest = std::max(1.0, background);
  for (const DrawnComponent& component : frame.components) {
    brightest = std::max(brightest, brightest_source(component));
  }
  return std::min(1.0, depth_to_light * brightest);
}

// What shines through an opacity o is at most (1 - o) times this.
double brightest_behind(const Frame& frame, double background) {
  double brightest = background;
  for (const DrawnComponent& component : frame.components) {
    brightest = std::max(brightest, brightest_source(component));
  }
  return brightest;
}

float opaque_limit(double brightest, double share) {
  constexpr float never = 2;
  if (!std::isfinite(brightest) || share <= 0) return never;
  return brightest > 0 ? static_cast<float>(1 - share / brightest) : 0.0f;
}

// How a relative error of the splats on coarse grids is spent: a fifth on the blur, which
// needs the least of it, the rest on the interpolation.
void plan_coarse_grids(const Frame& frame, double error, FrameLayout& layout) {
  constexpr double blur_part = 0.2;
  layout.refinement = choose_refinement((1 - blur_part) * error);
  layout.coarse_peak = static_cast<float>(brightest_coarse_peak(frame, error));
  double smallest_sigma =
      std::max(layout.refinement.smallest_sigma, static_cast<double>(layout.mean_sigma));
  // A blur would carry light over the edge of a cloud that is cut.
  layout.bands = !frame.kernel.cut;
  if (layout.bands) {
    layout.blur_error = blur_part * error;
    smallest_sigma = std::max(smallest_sigma, smallest_blurred_sigma(layout.blur_error));
    layout.blur[0] = largest_blur(smallest_sigma, layout.blur_error);
    layout.blur[1] = largest_blur(std::sqrt(2.0) * smallest_sigma, layout.blur_error);
  }
  layout.coarse_sigma = static_cast<float>(smallest_sigma);
}

// Projections that project_exact.cl knows; others take the kernels of single precision.
bool has_exact_projection(Projection projection) {
  return projection == Projection::perspective || projection == Projection::orthographic;
}

}  // namespace

std::size_t splat_bytes(const FrameLayout& layout) {
  return sizeof(kernel::Splat) + (layout.ellipses ? 2 * sizeof(float) : 0) +
         (layout.vector_colors ? 3 * sizeof(float) : 0);
}

int level_of_grid(const FrameLayout& layout, std::uint32_t grid) {
  return static_cast<int>(layout.bands ? (grid + 1) / 2 : grid);
}

double blur_of_grid(const FrameLayout& layout, std::uint32_t grid) {
  return layout.bands && grid > 0 ? layout.blur[grid % 2 == 1 ? 0 : 1] : 0;
}

// So many clouds of peak 0.1 overlapped in tests.
constexpr double ends_in_a_pixel = 24;

// In pixels: wider than the clouds of a crowd's first level, narrower than any on a coarse grid.
constexpr double narrow_sigma = 1.75;

FrameLayout make_layout(const Frame& frame, const Plan& plan, bool rows) {
  FrameLayout layout;
  layout.exact_numbers = plan.exact && has_exact_projection(frame.projection);
  layout.tile_width = 16;
  layout.tile_height = 16;
  if (rows && !layout.exact_numbers) {
    layout.tile_width = plan.light == LightPlan::ordered ? 32 : 64;
    layout.tile_height = 32;
  }
  layout.planes = plan.light == LightPlan::ordered ? 6 : 3;
  // A high and a low part of each.
  if (layout.exact_numbers) layout.planes *= 2;
  layout.vector_colors =
      std::any_of(frame.components.begin(), frame.components.end(), has_own_colors);
  layout.ellipses = frame.projection == Projection::equirectangular;
  if (layout.ellipses) layout.splats_per_particle = 7;  // wide_angle.cl: three on either side
  const double background = brightest_background(frame);
  // Beside a crowd of clouds a pixel may be dark, and errs by as much as its sum. Means of
  // narrow clouds, which stay on the picture's own grid, do not depend on it.
  const bool is_wide_crowd = plan.crowd.light > 0 && plan.crowd.widest_sigma > narrow_sigma;
  const double picture_error = is_wide_crowd ? 1 : response(frame, background);
  const double truncation = plan.truncation_share;
  layout.exact = frame.tolerance < 3e-4;
  // The polynomial's 6e-7 grows with sigma / pixel, to 1e-5 of the peak at sigma 6.
  layout.builtin_erf = frame.tolerance < 3e-5;
  const double loss = truncation / (uneven_light * picture_error);
  layout.least_extent = static_cast<float>(extent_of_loss(loss));
  layout.restored_light = static_cast<float>(0.5 * loss);
  layout.inverse_edge = static_cast<float>(ends_in_a_pixel / truncation);
  // A crowd's clouds end where the light of all of them has become so faint.
  layout.crowd_light = static_cast<float>(plan.crowd.light);
  const double fading = std::log(std::max(plan.crowd.light / truncation, 1.0));
  layout.crowd_extent = static_cast<float>(std::sqrt(fading));
  layout.crowd_narrowest = static_cast<float>(plan.crowd.narrowest_sigma);
  layout.crowd_widest = static_cast<float>(plan.crowd.widest_sigma);
  // Below, errors relative to a peak are no more than three times their shares; below twice
  // as much in a crowd, whose clouds do not all err alike unless they are all the same.
  layout.bright_peak = 8;
  layout.crowd_bright = layout.crowd_light > 2 * layout.bright_peak ? layout.crowd_light : 0;
  if (frame.kernel.sampling == Sampling::mean) {
    // The widened centre value errs by 7.7e-3 / sigma^4 of the peak.
    const double sigma = std::pow(7.7e-3 * picture_error / plan.pixel_mean_share, 0.25);
    layout.mean_sigma = static_cast<float>(std::clamp(sigma, 1.5, 64.0));
    layout.widening = 1.0f / 6.0f;
  }
  append_grid(layout, frame.crop.width, frame.crop.height, 0, layout.mean_sigma);
  layout.level_grids = {0};
  layout.coarse_sigma = std::numeric_limits<float>::max();
  if (may_use_coarse_grids(plan, layout)) {
    plan_coarse_grids(frame, plan.coarse_share / picture_error, layout);
    append_coarse_grids(layout, frame.crop);
  }
  // Two terms of the series err by y^2 / 6 of phi, four by y^4 / 120.
  layout.phi_short = static_cast<float>(std::min(0.5, std::sqrt(6 * plan.phi_share)));
  layout.phi_series = static_cast<float>(std::min(0.5, std::pow(120 * plan.phi_share, 0.25)));
  const double brightest = brightest_behind(frame, background);
  layout.opaque = opaque_limit(brightest, plan.stop_share);
  // An opacity close to 1 errs by ten roundings of 1 (exp, phi's difference and quotient, three
  // products, the sum), and with it what shines through.
  layout.keep_transmittance = plan.needs_sort && 10 * 0x1p-24 * brightest > plan.stop_share;
  return layout;
}

std::string kernel_defines(const Frame& frame, const Plan& plan, const FrameLayout& layout) {
  std::string defines;
  const auto define = [&defines](const std::string& text) { defines += "#define " + text + "\n"; };
  define("TILE_WIDTH " + std::to_string(layout.tile_width));
  define("TILE_HEIGHT " + std::to_string(layout.tile_height));
  if (plan.light == LightPlan::ordered) define("LIGHT_ORDERED");
  if (plan.light == LightPlan::emission) define("LIGHT_EMISSION");
  if (frame.kernel.cut) define("KERNEL_CUT");
  if (frame.kernel.sampling == Sampling::mean) define("SAMPLING_MEAN");
  if (layout.vector_colors) define("VECTOR_COLORS");
  if (layout.exact_numbers) define("EXACT_NUMBERS");
  if (layout.ellipses) define("ELLIPSES");
  if (layout.keep_transmittance) define("KEEP_TRANSMITTANCE");
  if (frame.projection == Projection::fisheye) define("PROJECTION_FISHEYE");
  if (layout.exact) define("EXACT");
  if (layout.builtin_erf) define("BUILTIN_ERF");
  std::ostringstream weights;
  weights << std::scientific << std::setprecision(9);
  for (const double weight : layout.refinement.weights) {
    weights << (weights.tellp() > 0 ? ", " : "{") << weight << "f";
  }
  define("REFINE_WEIGHTS " + weights.str() + "}");
  return defines;
}

}  // namespace splotchcl
