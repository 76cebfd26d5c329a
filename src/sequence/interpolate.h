#pragma once

#include <cstddef>
#include <optional>

#include "sequence/match_ids.h"
#include "splotchcl/particles.h"

namespace splotchcl {

// Values of one type's particles between two snapshots: those of the first in its order,
// then those that appear. Particles that vanish or appear keep the value that they have.
// Work is shared out to all cores; each value depends on its own particle alone.

// 0 <= fraction <= 1. `logarithmic`: of the logarithms, where both values are > 0.
Column interpolate_values(const Column& first, const Column& second, int values_per_particle,
                          const IdMatch& match, double fraction, bool logarithmic);

// One period of positions on every axis, [lower, lower + size), in the true coordinates.
struct PeriodicRange {
  double lower = 0;
  double size = 0;
};

// The period in which both columns lie, from 0 or around 0; none where they lie in neither:
// the header's box is then not that of the particles. `box` as the header has it.
std::optional<PeriodicRange> find_periodic_range(double box, const Column& first,
                                                 const Vec3& first_origin, const Column& second,
                                                 const Vec3& second_origin);

// One snapshot's part of a path.
struct PathEnd {
  Column position;
  Vec3 origin = {{0, 0, 0}};
  Column velocity;  // absent: straight lines
  double rate = 0;  // velocity * rate is the tangent: the path's change over the interval
};

// Positions relative to first.origin. With a period, each particle takes the shorter way and
// stays inside. With velocities, the path is the cubic with the tangents m of both ends:
//   x0 + (3 f^2 - 2 f^3) (x1 - x0) + (f - 2 f^2 + f^3) m0 + (f^3 - f^2) m1
// and particles that vanish or appear move on straight along their tangent.
Column interpolate_positions(const PathEnd& first, const PathEnd& second, const IdMatch& match,
                             double fraction, const std::optional<PeriodicRange>& period);

// 1 for those in both; those that vanish fade out with the fraction, those that appear in.
Column fade(const IdMatch& match, double fraction);

// How well velocities fit displacements: the root mean square of the mean tangents over that
// of the displacements, of particles in both. Nothing where none moves.
std::optional<double> tangent_ratio(const PathEnd& first, const PathEnd& second,
                                    const IdMatch& match,
                                    const std::optional<PeriodicRange>& period);

}  // namespace splotchcl
