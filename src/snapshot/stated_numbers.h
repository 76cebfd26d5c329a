#pragma once

#include <optional>
#include <string>
#include <vector>

#include "splotchcl/periodic.h"

// Numbers that a file states of the whole snapshot, as they are meant; notes tell where they are
// not taken as they stand.
namespace splotchcl {

// h, or H0 in km/s/Mpc, which is beyond any h; 0 where there is none.
double hubble_parameter_of(double stated, std::vector<std::string>& notes);

// As box_of(); zeros say that there is none.
std::optional<BoxSides> box_stated(const std::vector<double>& sides,
                                   std::vector<std::string>& notes);

}  // namespace splotchcl
