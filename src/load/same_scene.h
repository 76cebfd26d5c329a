#pragma once

#include "ranks/spread_particles.h"
#include "splotchcl/scene.h"

namespace splotchcl {

// Ranks that ask for different things would wait for each other for ever. Collective; throws
// UsageError, agreed upon, where they have not the same scene.
void require_same_scene(const Scene& scene, const SpreadParticles& spread);

}  // namespace splotchcl
