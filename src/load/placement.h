#pragma once

#include <optional>
#include <string>

#include "scene/particle_pass.h"
#include "splotchcl/frame.h"
#include "splotchcl/particles.h"
#include "splotchcl/selection.h"

namespace splotchcl {

// Where the particles of a placed component lie: x' = placed_origin + placed position, the
// sum in double precision (selection.h, Placement). `origin` is that of the positions.
Vec3 placed_origin(const Placement& placement, const Vec3& center, const Vec3& origin);

// Positions relative to placed_origin(), held in memory or made as they are wanted. A placement
// that neither turns nor scales moves the origin alone, and this is the column itself.
Column placed_positions(const Placement& placement, const Vec3& center, const Vec3& origin,
                        const Column& position, bool streams = false);

// Whether the column stays as it is.
bool only_moves(const Placement& placement);

// By Rodrigues' formula, right-handed.
Vec3 rotated(const Vec3& v, const Vec3& axis, double angle_degrees);

// A note where positions were stored as doubles, as offsets from an origin that is not 0, and the
// spacing of single precision there is more than a tenth of the size h that is drawn: how many
// particles, and how much of h at worst. Nothing where all lie as they should, or as the file has
// them.
std::optional<std::string> tell_rounded_positions(const DrawnComponent& component,
                                                  const ParticlePass& pass);

}  // namespace splotchcl
