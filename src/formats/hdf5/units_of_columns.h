#pragma once

#include <string>
#include <vector>

#include "formats/hdf5/hdf5_columns.h"

namespace splotchcl {

// The units that a file states for columns of one place in it, as attributes of each (units,
// openPMD's unitSI, those of Gadget and its relatives), or as astropy does beside a table. Empty
// where it states none.
std::vector<std::string> units_of_columns(const Hdf5File& file, const std::string& place,
                                          const std::vector<Hdf5Column>& columns);

}  // namespace splotchcl
