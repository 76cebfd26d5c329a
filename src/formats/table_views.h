#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "formats/table.h"

namespace splotchcl {

// The table itself, or, where its positions have x and y alone, one with a z of 0 beside them: a
// flow in a plane. Notes it.
std::unique_ptr<const Table> with_flat_positions(std::unique_ptr<const Table> table,
                                                 std::vector<std::string>& notes);

// Whether read.columns gives NAME=COLUMN, not names in the order of the columns. Throws UsageError
// for a mixture.
bool names_columns_anew(const std::vector<std::string>& wanted);

// The table itself, or, where read.columns gives NAME=COLUMN, one whose columns have these names;
// all others keep theirs. Throws UsageError for a column that is not there.
std::unique_ptr<const Table> with_new_names(std::unique_ptr<const Table> table,
                                            const std::vector<std::string>& wanted,
                                            const std::filesystem::path& path);

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
