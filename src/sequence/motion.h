#pragma once

#include "splotchcl/sequence.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// How stored velocities become changes of the stored positions: over a time of the runs, or
// over the scale factor, with dx/da = u a^p / (a^2 H(a)) (docs/time.md).
struct Motion {
  double first_time = 0, second_time = 0;  // or scale factors
  double first_rate = 1, second_rate = 1;  // factors on stored velocities
};

// Throws UsageError where the snapshots do not tell enough, or are of the same time.
Motion find_motion(const SnapshotInfo& first, const SnapshotInfo& second,
                   const SequenceSettings& settings);

// H(a) in units of H0, of a universe of matter, curvature and a cosmological constant.
double expansion_rate(double scale_factor, double omega_matter, double omega_lambda);

}  // namespace splotchcl
