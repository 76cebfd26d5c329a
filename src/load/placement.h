#pragma once

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

}  // namespace splotchcl
