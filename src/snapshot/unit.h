#pragma once

#include <array>
#include <cstddef>
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

}  // namespace splotchcl
