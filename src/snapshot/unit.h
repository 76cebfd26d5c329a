#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>

#include "splotchcl/snapshot.h"

namespace splotchcl {

// A unit as a factor on those of cgs and kelvin, and its powers of length, mass, time, temperature.
struct Unit {
  double in_cgs = 1;
  std::array<double, 4> powers = {0, 0, 0, 0};
};

Unit operator*(const Unit& a, const Unit& b);
Unit power(const Unit& unit, double exponent);
bool same_dimension(const Unit& a, const Unit& b);

// What the symbols a and h stand for in a snapshot; 0: not known.
struct UnitFactors {
  double scale_factor = 0, hubble = 0;
};
UnitFactors unit_factors(const SnapshotInfo& snapshot);

// Where the number that begins at `first` ends; there, where none does.
std::size_t end_of_number(const std::string& text, std::size_t first = 0);

// A product of numbers, names and their powers: "1e10 M_sun Mpc^-3 a^-3", "Msun/pc^2",
// "(km/s)^2", "4Mpc". A slash divides by what follows it next. `what` begins the message of the
// UsageError for a text that is none, or that needs a or h where they are not known.
Unit parse_unit(const std::string& text, const UnitFactors& factors, const std::string& what);
// Whether it is one where a and h are known.
bool is_unit(const std::string& text);

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
