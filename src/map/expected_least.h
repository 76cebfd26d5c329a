#pragma once

#include "map/placed_particles.h"
#include "map/sums.h"

namespace splotchcl {

// About the least that any pixel has of a request's sum, or of the smaller one of its sums
// (SumRequest): an estimate from few large cells, and of many
// particles from a part of them.
double expected_least_sum(const PlacedParticles& placed, const std::vector<float>& size,
                          const SumRequest& request, const SumPicture& picture);

}  // namespace splotchcl
