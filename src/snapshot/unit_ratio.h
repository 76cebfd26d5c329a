#pragma once

#include <optional>
#include <string>

#include "snapshot/unit.h"

namespace splotchcl {

// What numbers in the unit `from` have to be multiplied by to be in the unit `to`. 1 where nothing
// tells them apart: one of them is not said, neither is known, or both are mere numbers. None where
// they cannot be compared: they have different dimensions, one alone is known, or they differ by
// powers of a or h whose values are not known.
std::optional<double> unit_ratio(const std::string& from, const std::string& to,
                                 const UnitFactors& factors);

// The same, but none as well where a unit is not said or not known, unless both are the same text.
std::optional<double> ratio_of_known_units(const std::string& from, const std::string& to,
                                           const UnitFactors& factors);

// The unit of density that goes with those of a type's masses and positions, and the one of
// volume. Empty where one of them is not said.
std::string unit_of_matching_density(const ParticleTypeInfo& type);
std::string unit_of_matching_volume(const ParticleTypeInfo& type);

}  // namespace splotchcl
