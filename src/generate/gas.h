#pragma once

#include <cstdint>

#include "splotchcl/generate.h"

namespace splotchcl {

struct ParticleShares {
  std::uint64_t gas = 0, stars = 0;
};

// How many particles are gas and how many stars. Throws UsageError for settings out of
// range.
ParticleShares share_particles(const GenerateSettings& settings);

// Shares the masses of gas and stars between their particles, and fills in smoothing lengths and
// the gas's density as Gadget relates them: a ball of the smoothing length holds the mass of a
// fixed number of particles.
void set_masses(GeneratedSnapshot& snapshot, double of_gas, double of_stars);

}  // namespace splotchcl
