#pragma once

#include <string>

#include "splotchcl/snapshot.h"

namespace splotchcl {

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
