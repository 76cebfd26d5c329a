#include "scene/plan/splat_limits.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace splotchcl {
namespace {

// So many clouds of peak 0.1 overlapped in tests.
constexpr double ends_in_a_pixel = 24;

float stop_limit(double brightest, double share) {
  constexpr float never = -1;
  if (!std::isfinite(brightest) || share <= 0) return never;
  return brightest > 0 ? static_cast<float>(std::min(1.0, share / brightest)) : 1.0f;
}

// The widened center value errs by 7.7e-3 / sigma^4 of the peak.
float widest_of_means(double response, const ToleranceShares& shares) {
  const double sigma = std::pow(7.7e-3 * response / shares.pixel_mean, 0.25);
  // At least so much that octaves of widths up to 2 are of means alone, which the check after
  // drawing tells apart (certificate/octave_errors.cpp).
  constexpr double least = 1.96;
  return static_cast<float>(std::clamp(sigma, least, 64.0));
}

}  // namespace

double center_value_error(double sigma_pixels) {
  const double sigma2 = sigma_pixels * sigma_pixels;
  return 8.2e-3 / (sigma2 * sigma2);
}

// Along both axes, of the polynomials of erf (kernels/composite/shape.cl). Of the shorter one by
// computing them for widths from 0.5 to 2, of the longer one twice 1.8 of its error of 2.3e-7.
double error_of_means(Precision precision) {
  return precision == Precision::fast ? 3e-6 : 2 * 1.8 * 2.3e-7;
}

// Of the polynomials of exp (kernels/composite/gaussian.cl), along both axes.
double error_of_shapes(Precision precision) {
  return 2 * (precision == Precision::fast ? 2.7e-6 : 7.5e-8);
}

// The kernels work it out in single precision.
double widest_bright_mean(const SplatLimits& limits, double light) {
  constexpr double less = 0.999;
  const double wider = std::sqrt(std::max(0.853 * std::log(std::max(light, 1.0)), 1.0));
  return less * wider * static_cast<double>(limits.bright_mean_sigma);
}

double light_of_bright_means(const SplatLimits& limits, double sigma_pixels) {
  const double wider = sigma_pixels / widest_bright_mean(limits, 1);
  return std::exp(wider * wider / 0.853);
}

namespace {

constexpr double wide_mean = 3.9;  // WIDE_MEAN of shape.cl

// What the means of both axes err by that are differences of 1 - erf, which is known to that part
// of itself with the rounding of the difference; and those that are the value at the center, of
// exp's 3e-7, times a series, by one axis of which 2.5 roundings count.
constexpr double of_complements = 2 * 6e-7, of_series = 2 * (3e-7 + 2.5 * 0x1p-24);

// The first term that the series leaves out, at the distance where light of so much has faded to 1.
double end_of_series(double sigma_pixels, double light) {
  const double slope = 2 * std::sqrt(std::log(std::max(light, 1.0))) / sigma_pixels;
  return std::pow(slope, 8) / 9e7;
}

}  // namespace

// Of 1 - erf at both edges of a pixel, of which none is above 1 where both count from the same
// side.
double bright_mean_error(double narrowest_sigma, double widest_sigma) {
  constexpr double narrow = 0.5, per_sigma = 1.8;
  const double widest = std::clamp(widest_sigma, narrow, wide_mean);
  const double of_means = narrowest_sigma < wide_mean ? per_sigma * widest * of_complements : 0;
  return std::max(of_means, widest_sigma < wide_mean ? 0 : of_series);
}

// The sum of both edges is the largest part of their difference where one of them is the center.
// Roundings of the distance in sigma count with its square.
double part_of_bright_mean(double narrowest_sigma, double widest_sigma, double light) {
  constexpr double roundings_of_fading = 12 * 0x1p-24, narrow = 0.5;
  double part = 0;
  if (narrowest_sigma < wide_mean) {
    const double difference = std::erf(1 / std::clamp(widest_sigma, narrow, wide_mean));
    part = (2 - difference) / difference * of_complements;
  }
  if (widest_sigma >= wide_mean) {
    const double narrowest = std::max(narrowest_sigma, wide_mean);
    part = std::max(part, of_series + end_of_series(narrowest, light));
  }
  return part + roundings_of_fading * std::log(std::max(light, 1.0));
}

bool takes_pixel_means(const Frame& frame) {
  return frame.kernel.sampling == Sampling::mean && frame.projection != Projection::cube;
}

double edge_peak(const SplatLimits& limits) {
  const auto least_extent = static_cast<double>(limits.least_extent);
  return std::exp(least_extent * least_extent) / static_cast<double>(limits.inverse_edge);
}

double least_extent2(const FramePlan& plan, int octave) {
  const auto least_extent = static_cast<double>(plan.splats.least_extent);
  return least_extent * least_extent + plan.needs.widths[static_cast<std::size_t>(octave)].farther;
}

SplatLimits choose_splat_limits(const Frame& frame, const ToleranceShares& shares, LightPlan light,
                                const Responses& response) {
  SplatLimits limits;
  // Coarse grids have few pixels, so that drawing splats farther in sums costs little, and saves
  // drawing frames again.
  const double margin = light == LightPlan::ordered ? 1 : 5.5;
  const double left_out = shares.truncation / (margin * lattice_rows * response.of_ends);
  const double extent2 = -std::log(std::min(left_out, 1.0));
  limits.least_extent = static_cast<float>(std::sqrt(extent2));
  // A cut is part of the model: nothing is left out. Otherwise half of 1 - erf(k)^2.
  limits.restored_light =
      frame.kernel.cut ? 0.0f : static_cast<float>(std::erfc(std::sqrt(extent2)));
  limits.inverse_edge = static_cast<float>(ends_in_a_pixel / shares.truncation);
  limits.bright_peak = 8;
  if (takes_pixel_means(frame)) {
    limits.mean_sigma = widest_of_means(response.of_means, shares);
    limits.bright_mean_sigma = widest_of_means(response.of_bright_means, shares);
    limits.widening = 1.0f / 6.0f;
  }
  return limits;
}

// A layer of depth y whose phi errs by a part of itself is one of a splat that errs by
// phi(y) exp(y) = (exp(y) - 1) / y times that, for depths up to 0.5.
constexpr double phi_of_thin_layers = 1.3;

// Behind an opaque front each of a block's equal layers errs by the same half a rounding of 1.
std::uint32_t most_in_block(double promise, double brightest_behind, std::uint32_t longest) {
  constexpr std::uint32_t fewest = 32;
  constexpr double part_of_promise = 0.25, half_rounding = 0x1p-25;
  while (longest > fewest && longest * half_rounding * brightest_behind > part_of_promise * promise)
    longest /= 2;
  return longest;
}

LayerLimits choose_layer_limits(const ToleranceShares& shares, LightPlan light,
                                double brightest_behind, double response,
                                std::uint32_t longest_block) {
  LayerLimits limits;
  // One term of the series errs by y / 2 of phi, two by y^2 / 6, three by y^3 / 24, four by
  // y^4 / 120.
  limits.part = shares.phi / response;
  const double phi = limits.part / phi_of_thin_layers;
  limits.phi_first = static_cast<float>(std::min(0.5, 2 * phi));
  limits.phi_short = static_cast<float>(std::min(0.5, std::sqrt(6 * phi)));
  limits.phi_third = static_cast<float>(std::min(0.5, std::cbrt(24 * phi)));
  limits.phi_series = static_cast<float>(std::min(0.5, std::pow(120 * phi, 0.25)));
  limits.stop = stop_limit(brightest_behind, shares.early_stop);
  // An opacity close to 1 errs by ten roundings of 1 (exp, phi's difference and quotient, three
  // products, the sum), and with it what shines through.
  limits.keeps_transmittance =
      light == LightPlan::ordered && 10 * 0x1p-24 * brightest_behind > shares.early_stop;
  // Roundings of transmittances are parts of themselves.
  limits.most_in_block = limits.keeps_transmittance
                             ? longest_block
                             : most_in_block(shares.promise, brightest_behind, longest_block);
  return limits;
}

// How well the places of splats are known, in pixels, and what follows for sharp ones
// (docs/dev/accuracy.md, "Single precision").
namespace {

constexpr double rounding = 0x1p-24;

// The integers of splats' places hold the picture in 31 bits (picture_layout.cpp).
double largest_unit(const Frame& frame) {
  return 0x1p-30 * (std::max(frame.width, frame.height) + 256);
}

// Of a splat in the picture; the roundings are those of kernels/project/view.cl, x and y count from
// near the picture's middle.
void set_single_errors(const Frame& frame, PlaceLimits& limits) {
  const CameraFrame& camera = frame.camera;
  const double beside_x = std::abs(camera.center_x - 0.5 * frame.width);
  const double beside_y = std::abs(camera.center_y - 0.5 * frame.height);
  double per_pixel = 4;
  if (!is_wide_angle(frame.projection)) {
    // The scale errs as z does, by six roundings of the distance, three more and a division's.
    const bool is_flat = frame.projection == Projection::orthographic;
    const double corner = std::hypot(0.5 * frame.width + beside_x, 0.5 * frame.height + beside_y);
    per_pixel = is_flat ? 2 : 6 * std::hypot(1, corner / camera.focal_pixels) + 7;
  }
  limits.error_per_pixel = static_cast<float>(per_pixel + 2);
  // A unit of a splat's integers is a few roundings.
  const double unit = largest_unit(frame) / rounding;
  limits.error = static_cast<float>((per_pixel + 2) * (std::max(beside_x, beside_y) + 64) + unit);
}

// Of a splat whose place is computed in extended numbers: a unit of its integers, and the rounding
// of its place in a tile of at most 64 pixels.
double integer_place_error(const Frame& frame) {
  return largest_unit(frame) + 0x1p-19;
}

// The same with fractions of these units (kernels/common/splat.h): what the sixteen roundings of
// numbers of 43 bits at least leave, of places anywhere in the picture.
double fine_place_error(const Frame& frame) {
  const double farthest = 0.5 * std::max(frame.width, frame.height) + 64;
  return 0x1p-17 * largest_unit(frame) + 16 * 0x1p-43 * farthest;
}

// So many roundings count with the logarithm of a peak. A distance over sigma has six: of the
// constant in sigma, of its product with h, of the scale, of its product with that, of the pixel's
// edge and of the quotient. The exponent is its square, which exp takes without another one. Along
// the rows of a panorama two more are those of the latitude's cosine and of sigma over it. On a
// face of a cube six more are those of both tangents, and five of the pixel's secant and the
// quotient.
double roundings_of_fading(const FramePlan& plan) {
  if (plan.is_face_of_cube) return 24;
  return plan.has_ellipses ? 16 : 12;
}

// Of the tolerance, what one splat may spend by its place. Copies of one particle err alike: fifty
// of them may lie upon one another in single precision. Extended numbers err a hundred times less,
// and what they do not hold is drawn again.
constexpr double part_in_single = 0.02, part_in_extended = 0.5;

}  // namespace

PlaceLimits choose_place_limits(const Frame& frame, const FramePlan& plan, double response) {
  // What one splat may spend by its place; errors were a fifth of their bounds
  // (docs/dev/accuracy.md).
  const double allowed = plan.drawn_for_tolerance / std::max(1.0, response);
  PlaceLimits limits;
  set_single_errors(frame, limits);
  limits.share = part_in_single * allowed;
  limits.sharp_width = static_cast<float>(rounding / limits.share);
  limits.most_fading = std::numeric_limits<float>::max();
  // At larger tolerances it takes stars far smaller than a pixel, right at a pixel's edge.
  if (plan.precision != Precision::full) return limits;
  const double share = part_in_extended * allowed;
  const double error = plan.has_fine_places ? fine_place_error(frame) : integer_place_error(frame);
  limits.too_sharp_width = static_cast<float>(error / share);
  limits.most_fading = static_cast<float>(share / (roundings_of_fading(plan) * rounding));
  return limits;
}

}  // namespace splotchcl
