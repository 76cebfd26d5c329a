#pragma once

#include "splotchcl/particles.h"
#include "splotchcl/scene.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// The box that periodic.wrap uses. Throws UsageError where neither the scene nor
// the snapshot says one.
BoxSides periodic_box(const PeriodicSettings& settings, const SnapshotInfo& snapshot);

// Whether it is a part of the periodic box: what is placed elsewhere is not.
bool is_in_the_box(const Component& component);

// Moves each particle to its periodic image nearest to `center`, along each axis by itself:
// d = x - center becomes d - side * round(d / side), in double precision. The center becomes
// the particles' origin. Values that are not finite stay so. Positions are held in memory, or made
// as they are wanted.
void wrap_around(const Vec3& center, const BoxSides& box, Particles& particles,
                 bool streams = false);

}  // namespace splotchcl
