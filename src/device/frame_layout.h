#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "device/kernel_parameters.h"
#include "device/quirks.h"
#include "device/refinement_filter.h"
#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// How the picture lies in device memory: grids of pixels, cut in tiles, and the numbers
// that turn the plan's shares of the tolerance into limits for the kernels.
struct FrameLayout {
  std::vector<kernel::Grid> grids;  // grid 0 is the picture, the others only in sums
  std::uint32_t tile_width = 0, tile_height = 0;
  std::uint32_t tile_count = 0;
  std::uint32_t planes = 0;        // 3 sums, or 3 sources and 3 opacities
  std::uint64_t plane_floats = 0;  // all planes of all grids

  // The grid that collects level l, whose pixels are 2^l of the picture's wide.
  std::vector<std::uint32_t> level_grids;
  // Two grids for each level l > 0, which are blurred before they are collected: grid
  // 2 l - 1 by blur[0], grid 2 l by blur[1] (sigma^2 in pixels of their own; blur_filter.h).
  bool bands = false;
  double blur[2] = {0, 0};
  double blur_error = 0;  // of a splat's peak

  float mean_sigma = 0;   // narrower splats take the pixel mean by erf
  float widening = 0;     // of sigma^2, for wider ones
  float bright_peak = 0;  // brighter splats take means that keep more digits, also wider ones
  // Splats of such sigmas may lie upon one another, and add up to this light.
  float crowd_light = 0, crowd_narrowest = 0, crowd_widest = 0;
  float crowd_bright = 0;  // the same where they are to keep more digits
  float crowd_extent = 0;  // sigmas drawn of them at least
  RefinementFilter refinement;
  float coarse_peak = 0;                // brighter splats stay on grid 0
  float coarse_sigma = 0;               // smallest sigma in pixels of a coarse grid
  float least_extent = 0;               // sigmas drawn of a faint splat
  float restored_light = 0;             // part of a faint splat's weight that it gets back
  float inverse_edge = 0;               // 1 / (value at which a splat may end)
  float phi_short = 0, phi_series = 0;  // optical depths up to which a series serves
  float opaque = 0;
  bool keep_transmittance = false;  // opacity.cl: sources may show through opacities close to 1
  bool exact_numbers = false;       // tolerance 0: kernels of exact.cl
  bool vector_colors = false;       // some particles have colours of their own
  // Equirectangular pictures: splats are wider than high, and have copies beside the picture.
  bool ellipses = false;
  std::uint32_t splats_per_particle = 1;  // at most
  bool exact = false;                     // polynomials of full single precision
  bool builtin_erf = false;               // for tolerances that the polynomial cannot hold
};

// The level of a grid, whose pixels are 2^level of the picture's wide, and the sigma^2 by
// which it is blurred, in pixels of its own.
int level_of_grid(const FrameLayout& layout, std::uint32_t grid);
double blur_of_grid(const FrameLayout& layout, std::uint32_t grid);

FrameLayout make_layout(const Frame& frame, const Plan& plan, bool rows);

// The size of a splat: those of particles with colours of their own carry them.
std::size_t splat_bytes(const FrameLayout& layout);

// The block of #defines that specialises the kernels to the plan.
std::string kernel_defines(const Frame& frame, const Plan& plan, const FrameLayout& layout);

}  // namespace splotchcl
