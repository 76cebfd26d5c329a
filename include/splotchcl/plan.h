#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "splotchcl/frame.h"

// What a frame needs, decided once from the structure of its light, its tolerance and its
// particles. Every stage of the renderer takes its limits from here; nothing else reads
// Frame::tolerance. docs/dev/accuracy.md derives the numbers.
namespace splotchcl {

// Follows from the structure of the scene, never from comparing floats:
//   emission      nothing absorbs:  I = background + sum E X
//   proportional  E = q A for all:  I = q + (background - q) exp(-sum A X)
//   ordered       anything else:    sort, then layers nearer over farther
enum class LightPlan { emission, proportional, ordered };

enum class Precision {
  fast,      // single precision, short polynomials: exp to 2.7e-6, erf to 2.3e-6
  full,      // single precision to its last digits: exp to 7.5e-8, erf to 2.3e-7
  extended,  // double precision
};

// What Precision::extended promises, of max(1, |reference|).
constexpr double extended_tolerance = 1e-6;

// How the promise is shared out. The shares add up to it; each bounds (or estimates, where
// docs/dev/accuracy.md says so) one approximation's part of max(1, |reference|).
struct ToleranceShares {
  double promise = 0;       // Frame::tolerance, or extended_tolerance
  double truncation = 0;    // light left out by ending a splat
  double coarse_grids = 0;  // wide splats on grids of larger pixels (sums, or slabs of them)
  double pixel_mean = 0;    // center values in place of means over pixels
  double phi = 0;           // exp and (1 - exp(-y)) / y
  double early_stop = 0;    // what lies behind an opaque tile (ordered only)
  double slabs = 0;         // wide splats that are not in order (ordered only)
  double arithmetic() const { return pixel_mean + phi + early_stop; }
};

// What splats of one octave of widths need beyond what each by itself does, because many of them
// add up where it shows.
struct WidthNeed {
  double light = 0;    // at least 0: they count as bright ones, of this light or optical depth
  double farther = 0;  // added to the square of how many sigma of them are drawn
};

// By sigma in the picture's pixels, sigma'^2 = sigma^2 + widening: below 1, from 1 to 2, from 2 to
// 4, and so on; the last also beyond.
constexpr int width_octaves = 16;

// What the splats of a frame turned out to need when it was drawn: see refine_plan().
struct SplatNeeds {
  std::array<WidthNeed, width_octaves> widths;
  double grid_light = 1;  // of all that lies in one place on a coarse grid
  int slabs = 0;          // at least, of an ordered frame that is drawn in slabs
  // Ordered: what the picture makes of an error of a part of every layer, at least.
  double response_to_layers = 0;
};

// Where a splat ends and how its pixels are sampled. Widths in pixels.
struct SplatLimits {
  float mean_sigma = 0;         // narrower splats take the pixel mean by erf; 0: none does
  float widening = 0;           // of sigma^2, for wider ones, in pixels^2
  float bright_peak = 0;        // brighter splats take means that keep more digits, and
  float bright_mean_sigma = 0;  // take them up to this width and more, the brighter the farther
  float least_extent = 0;       // sigmas drawn of a faint splat
  float restored_light = 0;     // part of a faint splat's weight that it gets back
  float inverse_edge = 0;       // 1 / (value at which a splat may end)
};

// One grid of pixels of the whole picture: its own, or a coarser one with a guard band around it.
struct PictureGrid {
  int level = 0;              // its pixels are 2^level of the picture's wide
  int width = 0, height = 0;  // pixels, with the guard band
  int guard = 0;              // pixels on each side
};

// Taps of one axis that interpolate a grid to half its pixel size: weights of the old pixels
// -7 .. 8 for a new one a quarter of a pixel right of old pixel 0; they add up to 1.
constexpr std::size_t refinement_taps = 16;
struct RefinementFilter {
  std::array<double, refinement_taps> weights = {0, 0, 0, 0, 0, 0, 0, 1};
  double smallest_sigma = 0;  // narrowest splat, in old pixels, that it carries
  // Old pixels on either side of the one under a new pixel that it is made from.
  static constexpr int reach() { return static_cast<int>(refinement_taps) / 2; }
};

// Weights that become a round Gaussian of peak 1 when the grid is blurred, the same along either
// axis: of so many pixels, from 3 before to 4 behind the last one whose center lies before the
// splat's (or at it). With g the distance of the splat's center from the middle between that pixel
// and the next, v = (sigma^2 - middle) per_width, and a polynomial p_k(g^2, v) for each pixel, the
// weights are p_k + g p_(4 + k) from the first pixel on and p_k - g p_(4 + k) from the last one
// back, k = 0 .. 3.
constexpr std::size_t stencil_pixels = 8, stencil_place_powers = 3, stencil_width_powers = 4;
struct Stencil {
  double largest_sigma = 0;  // pixels of the grid
  double error = 0;          // of the peak, for one axis
  float middle = 0, per_width = 0;
  // Of the eight pixels' polynomials, for each power of g^2 those of all powers of v.
  std::array<float, stencil_place_powers * stencil_width_powers * stencil_pixels> coefficients{};
};

// The grids of a frame: grid 0 is the picture. Sums add wide splats to other grids, most of them
// coarser, which are blurred and interpolated up afterwards.
struct GridPyramid {
  std::vector<PictureGrid> grids;
  std::vector<int> level_grids;  // the grid that collects each level
  // As many grids for each level from first_level on as there are blurs: splats are drawn narrower,
  // and the grid is blurred by this sigma^2 (its own pixels^2), the first of a level by the least.
  // Empty: one grid, not blurred.
  std::vector<double> blurs;
  double blur_error = 0;  // of a splat's peak
  // The level of grid 1: 1, or 0 where there are grids of the picture's own pixels that are
  // blurred.
  int first_level = 1;
  // What splats of peaks up to 1 are drawn by on the grid of each blur; empty: by narrower
  // Gaussians.
  std::vector<Stencil> stencils;

  bool is_blurred() const { return !blurs.empty(); }
  bool has_stencils() const { return !stencils.empty(); }
  std::size_t grids_of_level() const { return is_blurred() ? blurs.size() : 1; }
  // Of a level from first_level on: of grids that are not the picture.
  std::size_t first_grid_of(int level) const {
    return 1 + static_cast<std::size_t>(level - first_level) * grids_of_level();
  }
  // Of grid 0 nothing.
  double blur_of(std::size_t grid) const {
    return is_blurred() && grid > 0 ? blurs[(grid - 1) % blurs.size()] : 0;
  }
  // How many times coarse_sigma a splat of this peak, above 1, needs to be as wide as, for the
  // grids of a level: its errors are as many times larger, and it is no stencil.
  double wider_for(double peak) const;
  // How many times as wide a splat is, sigma in pixels of the picture, as one has to be for grids
  // of level 1; less than 2^(first_level), or 0: it lies on the picture's own grid.
  double over_least_width(double sigma, double peak) const;

  RefinementFilter refinement;
  float coarse_peak = 0;   // brighter splats stay on grid 0
  float coarse_sigma = 0;  // smallest sigma in pixels of a coarse grid
};

// How many splats a frame is likely to have of widths that grids beside the picture's own are for,
// over the pixels of the whole picture: those that need pixels as small as the picture's, and wider
// ones, for coarser grids.
struct WideSplats {
  double of_one_octave = 0, wider = 0;
};

// Which splats are so sharp that single precision of their places would show. A splat whose place
// is off by a pixel errs by its slope per sigma (kernels/project/sharp_places.cl).
struct PlaceLimits {
  double share = 0;  // the most that one splat may spend, as an error of a sum
  // Roundings of a place in single precision, beside those of what is across the view.
  float error = 0, error_per_pixel = 0;
  // sigma per slope and rounding below which places are taken in extended numbers
  float sharp_width = 0;
  // sigma per slope below which the frame is drawn again in them, or ln of a peak above which it
  // is; 0: it never is
  float too_sharp_width = 0, most_fading = 0;
};

// How layers are put together.
struct LayerLimits {
  // The part by which splats may err alike, for the series of phi.
  double part = 0;
  // Optical depths up to which 1, 2, 3 and 4 terms of phi's series serve.
  float phi_first = 0, phi_short = 0, phi_third = 0, phi_series = 0;
  float stop = 0;  // a tile whose transmittance is at most this is finished; below 0: never
  // Light may show through opacities close to 1: transmittances are carried there.
  bool keeps_transmittance = false;
  // So many layers at most are put together before they come behind those in front:
  // equal ones err by equal roundings of an opacity, and light shows through that.
  std::uint32_t most_in_block = 1024;
};

struct FramePlan {
  LightPlan light = LightPlan::emission;
  std::array<double, 3> source = {1, 1, 1};  // q, for proportional
  Precision precision = Precision::fast;
  // Places of sharp splats are known to less than 1e-8 pixels.
  bool has_fine_places = false;
  // Few splats are added up at once, so that the roundings of sums do not show.
  bool adds_small_blocks = false;
  // Some particles have colors of their own.
  bool has_vector_colors = false;
  bool has_ellipses = false;     // splats are wider along x than along y, or the other way round:
  bool has_copies = false;       // in equirectangular pictures, with copies beside the picture,
  bool is_face_of_cube = false;  // and here, where their axes are turned as well
  int splats_per_particle = 1;   // at most

  bool certify = false;            // PlanOptions
  double drawn_for_tolerance = 0;  // what is shared out; at most the promise
  ToleranceShares shares;
  SplatNeeds needs;
  // Ordered: what lies behind a layer is expected to reach the eye with this light at most, so that
  // an error of absorption counts as so much of one of emission. The check after drawing takes the
  // picture's own light; a guess that is too low costs another drawing.
  double light_behind = 1;
  // Ordered: the part of all particles that is expected to be drawn. Only memory depends on it.
  double visible_part = 0;
  SplatLimits splats;
  double mean_error = 0;       // of pixel means by erf, as a part of a peak for each sigma
  double shape_error = 0;      // of values at pixel centers by exp, as a part of themselves
  double grid_peak_error = 0;  // of splats on coarse grids, as a part of their peak
  PlaceLimits places;
  WideSplats wide_splats;  // guessed of sums
  GridPyramid pyramid;
  // Ordered: splats are drawn in so many slabs of depth, each of as many of them. The wide ones of
  // a slab are added up on coarse grids and laid among its narrow ones, which are in order
  // (docs/dev/accuracy.md, "Slabs"). 0: all splats are in order.
  int slabs = 0;
  LayerLimits layers;
  // Parts of the whole picture that are drawn before all of it, one after the other: where a frame
  // is bright, only a drawing tells what it needs, and the plan is refined by that. Empty once they
  // have been: what is drawn by a plan that has some is seen by nobody.
  std::vector<Rectangle> tried_parts;
  bool is_trial() const { return !tried_parts.empty(); }

  // Whether the drawn splats have errors that add up, for the check to be told of them. The cut
  // values at pixel centers that the original program draws have none without coarse grids.
  bool has_errors_of_splats = true;

  bool needs_sort() const { return light == LightPlan::ordered; }
  bool is_extended() const { return precision == Precision::extended; }
};

// Variations that measurements ask for; pictures are drawn with the default.
struct PlanOptions {
  bool coarse_grids = true;
  // FramePlan::slabs of an ordered frame that can be drawn so; below 0: as many as seem to pay.
  int slabs = -1;
  // What is found after drawing is a bound, not an estimate (docs/dev/accuracy.md).
  bool certify = false;
};

// Decides everything.
FramePlan make_plan(const Frame& frame, const PlanOptions& options = {});

// The plan for drawing a frame again whose splats turned out to need more.
FramePlan refine_plan(const Frame& frame, const FramePlan& plan, const SplatNeeds& needs);
// The same for all splats alike: errors become this many times smaller.
FramePlan tighten_plan(const Frame& frame, const FramePlan& plan, double times);
// The plan without slabs.
FramePlan in_order_plan(const Frame& frame, const FramePlan& plan);
// The plan of the highest precision.
FramePlan extend_plan(const Frame& frame, const FramePlan& plan);

// The light alone, which needs no particles.
LightPlan choose_light(const Frame& frame);

// Lines for --explain: the plan, why it is exact, and how the tolerance is spent.
std::string explain(const FramePlan& plan, const Frame& frame);

const char* name(LightPlan light);
const char* name(Precision precision);

}  // namespace splotchcl
