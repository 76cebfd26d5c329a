#pragma once

#include <optional>

#include "scene/particle_pass.h"
#include "splotchcl/frame.h"

namespace splotchcl {

// The column of matter that should count as 1 so that brightness 1 is a good picture of
// this component, whatever the units of its masses and lengths. Nothing when the camera
// sees none of its particles. `component.reference_column` itself is not looked at. Ranks share the
// pass over its particles; without it this process looks at all.
std::optional<double> find_reference_column(const DrawnComponent& component, const Frame& frame,
                                            const ParticlePass& pass);
std::optional<double> find_reference_column(const DrawnComponent& component, const Frame& frame);

}  // namespace splotchcl
