#ifndef SPLOTCHCL_SPLOTCHCL_MPI_H
#define SPLOTCHCL_SPLOTCHCL_MPI_H

/* For C programs that use MPI themselves: their ranks draw together (splotchcl_c.h, "Ranks").
 * Nothing else of splotchcl needs MPI; the library loads a module for it when this is called. */

#include <mpi.h>

#include "splotchcl/splotchcl_c.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The ranks of a communicator, of which it takes a duplicate. Collective; after MPI_Init
 * (MPI_THREAD_FUNNELED is enough). Freed before MPI_Finalize. Null, with code 2 for another MPI
 * than Open MPI and MPICH and before MPI_Init, with 1 where the library was built without this one.
 */
static inline splotchcl_ranks* splotchcl_ranks_of(MPI_Comm communicator, splotchcl_error* error) {
#if defined(OPEN_MPI)
  return splotchcl_ranks_new("openmpi", &communicator, error);
#elif defined(MPICH_VERSION)
  return splotchcl_ranks_new("mpich", &communicator, error);
#else
  return splotchcl_ranks_new("an MPI that splotchcl does not know", &communicator, error);
#endif
}

#ifdef __cplusplus
}
#endif

#endif
