#pragma once

#include <vector>

#include "splotchcl/communicator.h"
#include "surroundings/cloud_around.h"

namespace splotchcl {

// Collective: the clouds of all ranks, those of the first one first; known to all.
std::vector<CloudAround> gather_clouds(Communicator& ranks, const std::vector<CloudAround>& own);

}  // namespace splotchcl
