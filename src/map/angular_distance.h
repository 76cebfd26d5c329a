#pragma once

#include "splotchcl/snapshot.h"

namespace splotchcl {

// The distance of angular diameters to the snapshot's redshift in Mpc, by its own densities of
// matter and of the cosmological constant, with curvature for what is missing to 1, and no
// radiation (D. W. Hogg, astro-ph/9905116, equations 14 to 18). Throws UsageError, which names
// map.distance, where the snapshot has no cosmology or no Hubble parameter, or lies at redshift 0.
double angular_distance_in_mpc(const SnapshotInfo& snapshot);

}  // namespace splotchcl
