#pragma once

#include <string>

#include "scene/particle_pass.h"
#include "splotchcl/frame.h"

namespace splotchcl {

// Throws DataError when a component has particles and all of them are bad, so that nothing of
// it could be drawn.
void check_particles(const DrawnComponent& component, const std::string& snapshot,
                     const ParticlePass& pass);

}  // namespace splotchcl
