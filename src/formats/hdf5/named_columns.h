#pragma once

#include <string>
#include <vector>

#include "formats/hdf5/hdf5_columns.h"

namespace splotchcl {

// The columns that read.columns names: NAME=PATH of a dataset below `group`, PATH:MEMBER of one of
// records, PATH:1 for the first column of one of several. Throws UsageError where there is none.
std::vector<Hdf5Column> named_columns(const Hdf5File& file, const std::string& group,
                                      const std::vector<std::string>& wanted);

}  // namespace splotchcl
