#pragma once

#include <memory>
#include <string>
#include <vector>

#include "formats/table.h"

namespace splotchcl {

// Steps in time that a table holds one below the other, as a column "step" or "time" tells:
// "step=0", "step=1", ... in their order. None where no particle is there twice.
std::vector<std::string> steps_in(const Table& table);

// The table of one step: of `wanted`, "step=3", or where that is empty of the last, with a note.
// All rows for "step=all". Throws DataError for a step that the table does not have.
std::unique_ptr<const Table> with_one_step(std::unique_ptr<const Table> table,
                                           const std::string& wanted, SnapshotInfo& info);

// "a/step=3" is "step=3" of the group "a".
struct GroupAndStep {
  std::string group, step;
};
GroupAndStep split_step(const std::string& group);

}  // namespace splotchcl
