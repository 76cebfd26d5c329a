// By what LANES splats are drawn, and on which grid: their widths, weights and radii there.
#include "kernels/common/common.cl"
#include "kernels/common/grid.h"
#include "kernels/common/lanes.cl"
#include "kernels/project/face_ellipse.cl"
#include "kernels/project/limits.cl"
#include "kernels/project/project.h"
#include "kernels/project/splat_brightness.cl"
#include "kernels/project/splat_place.cl"
#include "kernels/project/splat_widths.cl"
#include "kernels/project/view.cl"

#pragma OPENCL FP_CONTRACT OFF

// Sampling: narrow splats take means over pixels, others the center values of a widened
// Gaussian of the same light.
typedef struct SampledLanes {
  INTEGER by_mean;
  VALUE sigma, weight;
  INTEGER by_mean_x;  // of ellipses
  VALUE sigma_x;
} SampledLanes;

INLINED SampledLanes choose_sampling(const WidthLanes widths, const BrightnessLanes brightness,
                                     VALUE weight, const ProjectParameters p) {
  SampledLanes s;
  const VALUE sigma = drawn_sigma(widths), sigma_x = drawn_sigma_x(widths);
  VALUE mean_limit = (VALUE)(p.mean_sigma);
  if (ANY(brightness.bright)) {
    mean_limit = choose(mean_limit, bright_mean_limit(brightness.crowd_peak, p), brightness.bright);
  }
  s.by_mean = sigma < mean_limit;
  s.sigma = sigma;
  s.weight = weight;
  s.by_mean_x = sigma_x < mean_limit;
  s.sigma_x = sigma_x;
  if (p.widening == 0.0f) return s;
  const VALUE widened2 = sigma * sigma + p.widening;
  s.sigma = choose(sqrt(widened2), sigma, s.by_mean);
  if (ELLIPSES) {
    s.sigma_x = choose(sqrt(sigma_x * sigma_x + p.widening), sigma_x, s.by_mean_x);
    s.weight = weight * ((sigma / s.sigma) * (sigma_x / s.sigma_x));
  } else {
    // The square of the quotient of both widths, which does not wait for the root.
    s.weight = choose(weight * (1.0f - p.widening / widened2), weight, s.by_mean);
  }
  return s;
}

// Puts the splat on its grid: its width, weight and radius there. `extent` is in sigma.
INLINED void place_on_grid(SplatLanes* s, const ViewLanes view, const WidthLanes widths,
                           const SampledLanes sampled, const BrightnessLanes brightness,
                           VALUE extent, const ProjectParameters p) {
  s->grid = (INTEGER)(0);
  if (p.grid_count > 1) {
    // Coarse grids know center values only, and splats of a crowd may be taken as means that are
    // wide enough for one.
    s->grid =
        select(choose_grid(sampled.sigma, brightness.own_peak, p), (INTEGER)(0), sampled.by_mean);
  }
  const INTEGER level = level_of(s->grid, p);
  const VALUE shrink = AS_VALUE((127 - level) << 23);
  s->sigma = sampled.sigma * shrink;
  s->farthest_shown =
      choose(p.sigmas_shown * s->sigma, (VALUE)(FLT_MAX), brightness.own_peak > 1.0f);
  s->weight = sampled.weight;
  const INTEGER stencil = are_stencils(s->grid, s->sigma, brightness.own_peak, p);
  const INTEGER narrowed = (s->grid > 0) & (stencil == 0);
  if (p.blurs.sigma2[0] > 0.0f && ANY(narrowed)) {
    // The grid's blur widens what is drawn to the splat's width, and spreads its light.
    const VALUE drawn = sqrt(s->sigma * s->sigma - blur_of(s->grid, p));
    const VALUE spread = s->sigma / drawn;
    s->weight *= choose((VALUE)(1.0f), spread * spread, narrowed);
    s->sigma = choose(s->sigma, drawn, narrowed);
  }
  // A pixel mean sees a splat that reaches the pixel's edge. A cut disc has the radius of
  // the model's sigma, not of the widened one, and means always keep the pixel at its center.
  const VALUE edge = choose((VALUE)(0.0f), (VALUE)(0.5f), sampled.by_mean);
  const float cut_edge = SAMPLING_MEAN ? 0.5f : 0.0f;
  s->radius = p.kernel_cut > 0.0f ? p.kernel_cut * drawn_sigma(widths) * shrink + cut_edge
                                  : extent * s->sigma + edge;
  s->radius = choose(s->radius, (VALUE)(STENCIL_RADIUS), stencil);
  s->sigma = choose(s->sigma, -s->sigma, stencil);
  if (ELLIPSES) {
    // Such pictures have no coarse grids.
    const VALUE edge_x = choose((VALUE)(0.0f), (VALUE)(0.5f), sampled.by_mean_x);
    s->sigma_x = sampled.sigma_x;
    s->radius_x = p.kernel_cut > 0.0f ? p.kernel_cut * drawn_sigma_x(widths) + cut_edge
                                      : extent * sampled.sigma_x + edge_x;
  }
  if (FACE_OF_CUBE) {
    s->face = widths.face;
    s->part = widths.part;
    s->farther = face_reach(widths.face, extent, p);
    s->radius *= s->farther;
    s->radius_x *= s->farther;
  }
  s->x = view.x * shrink;
  s->y = view.y * shrink;
  VALUE farthest = max(fabs(s->x), fabs(s->y));
  if (COPIES) {
    farthest = max(farthest, s->radius_x + max(-p.left, p.right_end));
    farthest = max(farthest, s->radius + max(-p.top, p.bottom) + 2.0f);
  }
  s->place = splat_place(s->x, view.x_low * shrink, s->y, view.y_low * shrink, farthest, p);
  s->component_and_grid = (INTEGER)((int)p.component) | (s->grid << 16) | (s->place.coarser << 24);
}
