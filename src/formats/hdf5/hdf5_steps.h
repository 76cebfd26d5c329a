#pragma once

#include <string>
#include <vector>

#include "formats/hdf5/hdf5_file.h"

namespace splotchcl {

// Of these groups with particles those that are the same particles at several times, as H5Part
// writes them (Step#0, Step#1, ...), in the order of their numbers: their names differ in a number
// alone, and tell of steps or each state a time. Empty: they are none.
std::vector<std::string> find_steps(const Hdf5File& file, const std::vector<std::string>& groups);

}  // namespace splotchcl
