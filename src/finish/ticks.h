#pragma once

#include <string>
#include <vector>

#include "splotchcl/frame.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// A mark on an axis from 0 to 1.
struct Tick {
  double position = 0;
  double value = 0;   // before scaling
  std::string label;  // empty: a small mark without a number
};

// Marks at round values: about `most` with numbers at most. With `superscripts`, large and
// small numbers are written as powers with raised digits, else as 1e6.
std::vector<Tick> ticks_of(const ScalarMap& map, int most, bool superscripts);

// The largest of 1, 2 and 5 times a power of ten that is not above `value` > 0.
double round_below(double value);

// A number of few digits: 0.25, 1500, 3×10⁶.
std::string number_label(double value, bool superscripts);

// -12 as raised digits, in UTF-8.
std::string raised(int exponent);

// "km^2/s^2" with raised digits, "M_sun" as the sign of the sun's mass, "1e10" as 10 to the
// tenth, where the font has them.
std::string readable_unit(const std::string& unit, bool superscripts);

// "internal energy [km²/s²]": a field of a particle type; its name alone where the snapshot
// does not say a unit.
std::string field_label(const std::string& field, int type, const SnapshotInfo& snapshot,
                        bool superscripts);

// The unit of lengths, of the first type that has one; empty: unknown.
std::string length_unit(const SnapshotInfo& snapshot);

}  // namespace splotchcl
