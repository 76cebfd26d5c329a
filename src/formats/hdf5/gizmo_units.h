#pragma once

#include "formats/hdf5/hdf5_file.h"
#include "formats/unit_names.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// Whether the header states units as GIZMO does since 2020: UnitLength_In_CGS, UnitMass_In_CGS,
// UnitVelocity_In_CGS.
bool has_gizmo_units(const Hdf5File& file);

// The units that GIZMO computes in before they are divided by the Hubble parameter, which the
// attributes contain: fields have a power of h for it.
BaseUnits read_gizmo_units(const Hdf5File& file);

// Names the units of fields by what they are, since GIZMO's datasets state none: positions and
// smoothing lengths, masses, densities, velocities, internal energies, temperatures. Reads which
// factors of a and h they have from the header, and from whether the run is cosmological.
void name_gizmo_units(const Hdf5File& file, SnapshotInfo& info);

}  // namespace splotchcl
