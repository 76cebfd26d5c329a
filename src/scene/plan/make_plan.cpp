#include <algorithm>
#include <array>
#include <cmath>

#include "scene/plan/error_budget.h"
#include "scene/plan/grid_pyramid.h"
#include "scene/plan/guesses.h"
#include "scene/plan/light_structure.h"
#include "scene/plan/splat_limits.h"
#include "splotchcl/plan.h"

namespace splotchcl {
namespace {

// Copies of a splat in an equirectangular picture, half a period apart and every other one twice:
// it is mirrored over both poles (kernels/project/wide_angle.cl).
constexpr int splats_with_copies = 19;

// Narrow splats are those of dense places, where many lie close together, and drawing them
// farther costs little: most of their cost does not depend on their area. With these, few frames
// are drawn again (docs/dev/tuning.md, "The check after drawing").
std::array<double, 6> first_farther(const FramePlan& plan) {
  if (!plan.needs_sort()) return {1.9, 1.4, 0.6, 0.0, 0.0, 0.0};
  // On coarse grids, which have few pixels, as far as in sums (choose_splat_limits).
  if (plan.slabs > 0) return {3.5, 3.0, 2.3, 3.0, 2.0, 1.5};
  return {3.5, 3.0, 2.3, 1.8, 0.6, 0.0};
}

SplatNeeds first_needs(const FramePlan& plan, double light_of_errors) {
  SplatNeeds needs;
  if (plan.is_extended()) return needs;
  const std::array<double, 6> farther = first_farther(plan);
  // The smaller the tolerance, the more of it goes to errors of peaks that lie upon one another.
  const bool is_full = plan.precision == Precision::full, is_finest = plan.adds_small_blocks;
  const double in_full = is_full ? 0.8 : 0;
  for (std::size_t octave = 0; octave < farther.size(); ++octave) {
    needs.widths[octave].farther =
        std::max(0.0, farther[octave] + in_full + std::log(light_of_errors));
  }
  if (is_full) needs.grid_light = is_finest ? 4 : 3;
  const std::array<double, 5> light = {100, 100, 100, 6, 12};
  for (std::size_t octave = 0; is_finest && octave < light.size(); ++octave)
    needs.widths[octave].light = light[octave];
  return needs;
}

// Where nothing absorbs, light adds up without end: what many splats in one place need grows with
// it. Of snapshots of galaxies and of the universe the check asked for what these factors give.
// Frames that are less bright rarely need it, and it costs them four tenths of their time. What is
// brighter than `most` may err by as much more, but for its edges (docs/tuning.md).
void add_needs_of_light(double brightness, FramePlan& plan) {
  constexpr double bright = 3, most = 12, most_on_grids = 9, of_grids = 15, of_ends = 4,
                   of_means = 6;
  constexpr std::size_t first_octave = 2, end_of_means = 4;
  if (plan.is_extended() || brightness < bright) return;
  brightness = std::min(brightness, most);
  plan.needs.grid_light =
      std::max(plan.needs.grid_light, of_grids * std::min(brightness, most_on_grids));
  for (std::size_t octave = first_octave; octave < plan.needs.widths.size(); ++octave) {
    WidthNeed& need = plan.needs.widths[octave];
    need.farther += std::log(of_ends * brightness);
    if (octave < end_of_means) need.light = std::max(need.light, of_means * brightness);
  }
}

// The more grids share out a level's widths, the narrower their splats are drawn, and the more
// there is to blur for each pixel: in slabs once for each of them (docs/dev/tuning.md).
int choose_blurs_of_level(const Frame& frame, const FramePlan& plan) {
  constexpr int few = 2;
  const auto pixels =
      static_cast<std::uint64_t>(frame.width) * static_cast<std::uint64_t>(frame.height);
  const bool pays = plan.slabs == 0 && particle_count(frame) >= pixels;
  return pays ? most_blurs(frame) : few;
}

// A stencil takes a third of the time of a narrower Gaussian, and a quarter of a splat that is
// drawn as wide as it is. Four grids of the picture's own pixels take as long to blur as half as
// many splats take, and as much memory as six pictures, which takes a first frame longer than that
// (docs/dev/tuning.md).
void set_use_of_stencils(const WideSplats& splats, PyramidNeeds& needs) {
  constexpr double fewest_of_own_pixels = 3, fewest = 0.1;
  const bool own_pixels = splats.of_one_octave >= fewest_of_own_pixels;
  needs.first_level = own_pixels ? 0 : 1;
  needs.stencils = own_pixels || (splats.wider >= fewest && splats.wider >= splats.of_one_octave);
}

bool may_have_stencils(const Frame& frame, const FramePlan& plan) {
  return !plan.needs_sort() && plan.precision == Precision::fast && plan.shares.coarse_grids > 0 &&
         !plan.has_ellipses && !frame.kernel.cut;
}

GridPyramid choose_pyramid(const Frame& frame, const FramePlan& plan) {
  // Coarse grids are for round splats. They soften the edges of cut ones, which shows where many
  // lie upon one another.
  constexpr double soft_edges_tolerance = 0.03;
  const bool has_hard_edges =
      frame.kernel.cut &&
      (plan.drawn_for_tolerance < soft_edges_tolerance || plan.needs.grid_light > 1);
  const bool has_coarse_grids =
      plan.shares.coarse_grids > 0 && !plan.has_ellipses && !has_hard_edges;
  if (!has_coarse_grids) return make_single_grid(frame);
  PyramidNeeds needs;
  needs.mean_sigma = plan.splats.mean_sigma;
  needs.error = plan.grid_peak_error / plan.needs.grid_light;
  needs.blurs_of_level = choose_blurs_of_level(frame, plan);
  if (may_have_stencils(frame, plan)) set_use_of_stencils(plan.wide_splats, needs);
  return make_pyramid(frame, needs);
}

// What ends of splats do where light is uneven, beyond what even light allows for (set_limits):
// errors in dim pictures show less.
double light_of_uneven_ends(const Frame& frame, const FramePlan& plan) {
  if (!plan.needs_sort()) return 1;
  const double response =
      response_to_splats(plan.light, brightest_source(frame), brightest_background(frame));
  return std::min(1.0, std::max(plan.light_behind, response));
}

// What an error of a part of every layer does to the picture: to a single source 1 / e of it, and
// more where brighter ones may be behind it. What is guessed too low the check after drawing finds.
double response_to_layers(const Frame& frame, const FramePlan& plan, double most) {
  constexpr double of_sources = 0.9;
  const bool can_guess =
      plan.needs_sort() && !plan.is_extended() && std::isfinite(brightest_source(frame));
  const double guess =
      can_guess ? std::min(most, of_sources * plan.light_behind) : std::max(1.0, most);
  return std::max(guess, plan.needs.response_to_layers);
}

// Of layers whose roundings do not show. Adding up small blocks takes rows as long as drawing them.
std::uint32_t longest_block(const FramePlan& plan) {
  if (plan.adds_small_blocks) return 32;
  return plan.precision == Precision::fast ? 1024 : 256;
}

void set_limits(const Frame& frame, FramePlan& plan) {
  const double background = brightest_background(frame);
  const double source = brightest_source(frame);
  const double response = response_to_splats(plan.light, source, background);
  const double unchecked = response_to_unchecked(plan.light, source, background);
  // Even light errs by no more than itself for each depth of 1.
  const double of_even_light = plan.needs_sort() ? std::min(response, plan.light_behind) : response;
  plan.splats =
      choose_splat_limits(frame, plan.shares, plan.light, {of_even_light, response, unchecked});
  plan.mean_error = error_of_means(plan.precision);
  plan.grid_peak_error = plan.shares.coarse_grids / response;
  plan.pyramid = choose_pyramid(frame, plan);
  plan.has_errors_of_splats =
      !plan.is_extended() && (plan.certify || !frame.kernel.cut || takes_pixel_means(frame) ||
                              plan.pyramid.grids.size() > 1);
  if (plan.is_extended()) {
    plan.places = {};
  } else {
    const double of_places = plan.precision == Precision::full ? unchecked : response;
    plan.places = choose_place_limits(frame, plan, of_places);
  }
  const double of_layers = response_to_layers(frame, plan, unchecked);
  plan.shape_error = error_of_shapes(plan.precision);
  plan.layers = choose_layer_limits(plan.shares, plan.light, std::max(background, source),
                                    of_layers, longest_block(plan));
  // Pairs of floats hold as little as shows through, too.
  if (plan.is_extended()) plan.layers.keeps_transmittance = plan.needs_sort();
}

// Bounds are several times larger than estimates.
constexpr double first_part_certified = 0.05;

// Slabs pay in large frames that are not bright: the light that wide splats may change by their
// order is that of the picture (docs/dev/accuracy.md, "Slabs"). What is guessed wrong here costs
// time. Laying ten slabs, and drawing in order where they do not suffice, takes as long for a pixel
// as some thousand wide splats do in order (docs/dev/tuning.md, "Slabs").
int choose_slabs(const Frame& frame, const FramePlan& plan, double wide_layers,
                 const PlanOptions& options) {
  constexpr int first_slabs = 10;
  constexpr std::uint64_t fewest_particles = 1u << 19;
  constexpr double brightest = 0.3, fewest_layers = 1500;
  const bool is_possible = plan.needs_sort() && plan.precision == Precision::fast &&
                           !plan.has_ellipses && !frame.kernel.cut && !plan.certify &&
                           options.coarse_grids;
  if (!is_possible) return 0;
  if (options.slabs >= 0) return options.slabs;
  const bool pays = particle_count(frame) >= fewest_particles && wide_layers >= fewest_layers &&
                    plan.light_behind <= brightest;
  return pays ? first_slabs : 0;
}

void set_budget(const ErrorBudget& budget, FramePlan& plan) {
  plan.precision = budget.precision;
  plan.has_fine_places = budget.has_fine_places;
  plan.adds_small_blocks = budget.adds_small_blocks;
  plan.shares = budget.shares;
}

}  // namespace

LightPlan choose_light(const Frame& frame) {
  return find_light_structure(frame).light;
}

FramePlan make_plan(const Frame& frame, const PlanOptions& options) {
  FramePlan plan;
  const LightStructure structure = find_light_structure(frame);
  plan.light = structure.light;
  plan.source = structure.source;
  plan.has_vector_colors =
      std::any_of(frame.components.begin(), frame.components.end(), has_own_colors);
  plan.has_copies = frame.projection == Projection::equirectangular;
  plan.is_face_of_cube = frame.projection == Projection::cube;
  plan.has_ellipses = plan.has_copies || plan.is_face_of_cube;
  if (plan.has_copies) plan.splats_per_particle = splats_with_copies;

  plan.certify = options.certify;
  plan.drawn_for_tolerance = frame.tolerance * (options.certify ? first_part_certified : 1);
  set_budget(make_error_budget(frame, plan.drawn_for_tolerance, plan.light,
                               !plan.needs_sort() && options.coarse_grids),
             plan);
  OrderedGuess guess;
  if (plan.needs_sort() && !plan.is_extended()) guess = guess_order(frame);
  plan.light_behind = guess.light_behind;
  plan.visible_part = guess.visible_part;
  plan.slabs = choose_slabs(frame, plan, guess.wide_layers, options);
  if (plan.slabs > 0) {
    set_budget(make_error_budget(frame, plan.drawn_for_tolerance, plan.light, true), plan);
  }
  plan.needs = first_needs(plan, light_of_uneven_ends(frame, plan));
  if (may_have_stencils(frame, plan))
    plan.wide_splats = guess_wide_splats(frame, about_narrowest_stencil);
  if (plan.light == LightPlan::emission) add_needs_of_light(guess_brightness(frame), plan);
  set_limits(frame, plan);
  // Small pictures have one grid, and transmittances that are carried are not laid.
  const bool has_slabs = plan.pyramid.grids.size() > 1 && !plan.layers.keeps_transmittance;
  return plan.slabs > 0 && !has_slabs ? in_order_plan(frame, plan) : plan;
}

FramePlan in_order_plan(const Frame& frame, const FramePlan& plan) {
  FramePlan ordered = plan;
  ordered.slabs = 0;
  set_budget(make_error_budget(frame, plan.drawn_for_tolerance, plan.light, false), ordered);
  ordered.needs = first_needs(ordered, light_of_uneven_ends(frame, ordered));
  ordered.needs.response_to_layers = plan.needs.response_to_layers;
  set_limits(frame, ordered);
  return ordered;
}

FramePlan refine_plan(const Frame& frame, const FramePlan& plan, const SplatNeeds& needs) {
  // More of them take as long to lay as splats take in order.
  constexpr int most_slabs = 32;
  if (plan.slabs > 0 && needs.slabs > most_slabs) return in_order_plan(frame, plan);
  FramePlan refined = plan;
  refined.slabs = plan.slabs > 0 ? std::max(plan.slabs, needs.slabs) : 0;
  for (std::size_t octave = 0; octave < needs.widths.size(); ++octave) {
    WidthNeed& need = refined.needs.widths[octave];
    need.farther += needs.widths[octave].farther;
    need.light = std::max(need.light, needs.widths[octave].light);
  }
  refined.needs.grid_light = std::max(refined.needs.grid_light, needs.grid_light);
  refined.needs.response_to_layers =
      std::max(refined.needs.response_to_layers, needs.response_to_layers);
  set_limits(frame, refined);
  return refined;
}

FramePlan tighten_plan(const Frame& frame, const FramePlan& plan, double times) {
  FramePlan tightened = plan;
  tightened.drawn_for_tolerance /= times;
  set_budget(make_error_budget(frame, tightened.drawn_for_tolerance, plan.light,
                               plan.shares.coarse_grids > 0),
             tightened);
  set_limits(frame, tightened);
  return tightened;
}

FramePlan extend_plan(const Frame& frame, const FramePlan& plan) {
  FramePlan extended = plan;
  set_budget(make_extended_budget(), extended);
  extended.slabs = 0;
  extended.needs = {};
  extended.light_behind = 1;
  set_limits(frame, extended);
  return extended;
}

}  // namespace splotchcl
