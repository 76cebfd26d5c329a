#pragma once

#include <memory>
#include <string>
#include <vector>

#include "formats/table.h"

namespace splotchcl {

// The table itself, or, where its positions have x and y alone, one with a z of 0 beside them: a
// flow in a plane. Notes it.
std::unique_ptr<const Table> with_flat_positions(std::unique_ptr<const Table> table,
                                                 std::vector<std::string>& notes);

}  // namespace splotchcl
