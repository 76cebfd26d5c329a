#pragma once

#include <array>
#include <vector>

#include "map/placed_particles.h"
#include "splotchcl/scene.h"
#include "splotchcl/views.h"

namespace splotchcl {

// Sums over particles, pixel by pixel, as the red, green and blue of one frame that nothing
// absorbs: they share their splats.
struct SumRequest {
  // Of each placed particle, >= 0: what its kernel spreads over the picture. It outlives the
  // request.
  const std::vector<float>& weight;
  // Three factors >= 0 of each placed particle, one for each sum; empty: the weights alone are
  // summed up. The second and the third are two parts of one sum, as what lies above 0 and below.
  std::vector<float> factors;
  // Per pixel, > 0, and at least least_floor() of the weights. Each sum is known to the tolerance
  // of itself, or of both parts together, or of this or least_floor() where that is more.
  double floor = 1;
  // Else they are three sums, of which each is known to the tolerance of itself or of the floor.
  bool are_parts = true;
};

// Per pixel, row 0 at the top, in the weights' unit; without factors the first one alone.
using PixelSums = std::array<std::vector<double>, 3>;

struct SumPicture {
  int width = 0, height = 0;
  double kernel_width = 1;  // sigma = kernel_width * h
  double tolerance = 1e-3;
};

// The least floor that sums of these may have: a hair of what the brightest particle gives a pixel,
// beyond which devices have no digits. `factors` may be empty (SumRequest).
double least_floor(const std::vector<float>& size, const std::vector<float>& weight,
                   const std::vector<float>& factors, double kernel_width);

// `size` is h of each placed particle in pixels.
PixelSums draw_sums(const PlacedParticles& placed, const std::vector<float>& size,
                    SumRequest request, const SumPicture& picture, const DrawFrame& draw);

}  // namespace splotchcl
