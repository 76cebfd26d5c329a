#pragma once

#include "io/snapshot/gadget_header.h"
#include "io/snapshot/hdf5_file.h"
#include "io/snapshot/unit_names.h"

namespace splotchcl {

// Reads the group Header of Gadget 2 to 4, SWIFT and their relatives: attributes may be
// scalars or arrays of any length, and cosmology may be in other groups. Throws DataError.
GadgetHeader read_hdf5_header(const Hdf5File& file);

bool is_swift_file(const Hdf5File& file);

// The units the file states; zeros where it states none.
BaseUnits read_base_units(const Hdf5File& file);
UnitPowers read_unit_powers(const Hdf5File& file, const Hdf5Dataset& dataset);

}  // namespace splotchcl
