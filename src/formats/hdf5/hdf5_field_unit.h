#pragma once

#include <optional>
#include <string>

#include "formats/hdf5/hdf5_file.h"
#include "formats/unit_names.h"

namespace splotchcl {

// The power of the scale factor that makes a dataset's values physical, where its attributes say
// it.
std::optional<double> read_scale_factor_power(const Hdf5File& file, const std::string& dataset);

// The unit that the attributes of a dataset of Gadget 4, AREPO, SWIFT or EAGLE state, in which the
// file's base units are `units`. Empty where they state none.
std::string read_field_unit(const Hdf5File& file, const Hdf5Dataset& dataset,
                            const BaseUnits& units);

}  // namespace splotchcl
