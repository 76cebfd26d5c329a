#pragma once

#include <optional>
#include <string>

#include "scene/particle_pass.h"
#include "splotchcl/frame.h"

namespace splotchcl {

// A note where positions were stored as doubles, as offsets from an origin that is not 0, and the
// spacing of single precision there is more than a tenth of the size h that is drawn: how many
// particles, and how much of h at worst. Nothing where all lie as they should, or as the file has
// them.
std::optional<std::string> tell_rounded_positions(const DrawnComponent& component,
                                                  const ParticlePass& pass);

}  // namespace splotchcl
