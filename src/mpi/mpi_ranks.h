#pragma once

#include <mpi.h>

#include <memory>

#include "splotchcl/communicator.h"

namespace splotchcl {

// Ranks of an MPI communicator. What they tell each other does not meet what the program around
// sends: they have a duplicate of it. Collective. `ends_mpi`: MPI is finalized when it goes.
std::unique_ptr<Communicator> mpi_ranks(MPI_Comm communicator, bool ends_mpi);

}  // namespace splotchcl
