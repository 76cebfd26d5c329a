#pragma once

#include <memory>
#include <string>
#include <vector>

#include "splotchcl/snapshot.h"

namespace splotchcl {

// The snapshot with units that its file does not say, or says wrongly: FIELD=UNIT, by any name of
// the field, or the name of a system for all that it does not say. Numbers stay, but smoothing
// lengths are then in the unit of positions. Throws UsageError for fields that no type has, and for
// what is no unit.
std::unique_ptr<Snapshot> with_named_units(std::unique_ptr<Snapshot> snapshot,
                                           const std::vector<std::string>& units);

}  // namespace splotchcl
