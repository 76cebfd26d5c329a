#pragma once

#include <mpi.h>

#include <memory>

#include "splotchcl/communicator.h"

// For programs that use MPI themselves: their ranks draw together. Nothing else of splotchcl needs
// MPI; the library loads a module for it (Open MPI, MPICH) when this is called.
namespace splotchcl {

// The ranks of a communicator, of which it takes a duplicate: what they tell each other does not
// meet what the program sends. Collective; after MPI_Init (MPI_THREAD_FUNNELED is enough: MPI is
// called by the threads that call the library alone). The result goes, with all that has it, before
// MPI_Finalize. Throws as ranks_of_mpi does. With another MPI, derive from Communicator.
inline std::shared_ptr<Communicator> ranks_of(MPI_Comm communicator) {
#if defined(OPEN_MPI)
  return ranks_of_mpi("openmpi", &communicator);
#elif defined(MPICH_VERSION)
  return ranks_of_mpi("mpich", &communicator);
#else
  return ranks_of_mpi("an MPI that splotchcl does not know", &communicator);
#endif
}

}  // namespace splotchcl
