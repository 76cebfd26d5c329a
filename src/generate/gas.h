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

// Shares a mass between the particles.
void set_mass(GeneratedParticles& particles, double total);

// Fills in smoothing lengths and the gas's density as Gadget relates them: a ball of the
// smoothing length holds the mass of a fixed number of particles.
void find_density(GeneratedSnapshot& snapshot);

}  // namespace splotchcl
