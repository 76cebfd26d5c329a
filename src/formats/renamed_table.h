#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "formats/table.h"

namespace splotchcl {

// Whether read.columns gives NAME=COLUMN, not names in the order of the columns. Throws UsageError
// for a mixture.
bool names_columns_anew(const std::vector<std::string>& wanted);

// The table itself, or, where read.columns gives NAME=COLUMN, one whose columns have these names;
// all others keep theirs. Throws UsageError for a column that is not there.
std::unique_ptr<const Table> with_new_names(std::unique_ptr<const Table> table,
                                            const std::vector<std::string>& wanted,
                                            const std::filesystem::path& path);

}  // namespace splotchcl
