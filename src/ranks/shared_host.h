#pragma once

#include "splotchcl/communicator.h"

namespace splotchcl {

// Ranks on one host share out its cores: PoCL, which else takes all of them for each process, is
// told how many threads to have, unless the user's environment tells it. Before the first OpenCL
// call.
void share_cores(const Communicator& ranks);

// Of so many cores, of which this process may use `allowed`, each of `ranks` processes takes these.
int cores_of_rank(int cores, int allowed, int ranks);

}  // namespace splotchcl
