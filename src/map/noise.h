#pragma once

#include <vector>

#include "map/placed_particles.h"
#include "map/sums.h"
#include "map/weighted_values.h"

namespace splotchcl {

// (sum w)^2 / sum w^2 per pixel, with w what each particle adds there: how many particles of equal
// weight would be as noisy. Not a number where the weights are below the floor. `weighted` has been
// drawn.
// `floor` is the map's, a part of the mean.
std::vector<float> draw_effective_particles(const PlacedParticles& placed,
                                            const WeightedValues& weighted,
                                            const SumPicture& picture, double floor,
                                            const DrawFrame& draw);

}  // namespace splotchcl
