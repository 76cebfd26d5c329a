#pragma once

#include <cstdint>
#include <vector>

#include "splotchcl/particles.h"

namespace splotchcl {

// The particles at these places, in memory. Values that are made when they are wanted are made for
// these alone, particle by particle.
Particles picked_particles(const Particles& particles, const std::vector<std::uint64_t>& places);

}  // namespace splotchcl
