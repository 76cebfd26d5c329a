#pragma once

#include <cstdint>

#include "splotchcl/generate.h"

namespace splotchcl {

struct ParticleShares {
  std::uint64_t gas = 0, stars = 0;
};

// Record lengths of a Gadget file are 32 bits: positions take 12 bytes a particle.
constexpr std::uint64_t most_in_one_file = 170'000'000;

// How many particles are gas and how many stars. Throws UsageError for settings out of
// range.
ParticleShares share_particles(const GenerateSettings& settings,
                               std::uint64_t most = most_in_one_file);

// Of gas with a mass and smoothing lengths, as Gadget relates them.
void set_densities(GeneratedParticles& gas);

// Shares the masses of gas and stars between their particles, and fills in smoothing lengths and
// the gas's density as Gadget relates them: a ball of the smoothing length holds the mass of a
// fixed number of particles.
void set_masses(GeneratedSnapshot& snapshot, double of_gas, double of_stars);

}  // namespace splotchcl
