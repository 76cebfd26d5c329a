#pragma once

#include <optional>
#include <string>

#include "formats/hdf5/hdf5_file.h"
#include "formats/unit_names.h"

namespace splotchcl {

// Attributes of a dataset that state how large its unit is in cgs.
constexpr const char* size_in_gadget = "to_cgs";  // of Gadget 4 and AREPO
constexpr const char* size_in_eagle = "CGSConversionFactor";
constexpr const char* size_in_swift =
    "Conversion factor to CGS (not including cosmological corrections)";

// The power of the scale factor that makes a dataset's values physical, where its attributes say
// it.
std::optional<double> read_scale_factor_power(const Hdf5File& file, const std::string& dataset);

// What a file says of all its fields' units.
struct UnitsOfFile {
  BaseUnits base;
  // Without cosmology there is none that a unit could have powers of.
  bool has_scale_factor = true;
};
UnitsOfFile read_units(const Hdf5File& file);

// The unit that the attributes of a dataset of Gadget 4, AREPO, SWIFT or EAGLE state. Empty where
// they state none.
std::string read_field_unit(const Hdf5File& file, const Hdf5Dataset& dataset,
                            const UnitsOfFile& units);

}  // namespace splotchcl
