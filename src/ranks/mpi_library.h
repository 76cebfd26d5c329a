#pragma once

#include <memory>
#include <string>

#include "splotchcl/communicator.h"

namespace splotchcl {

// All that is done by MPI. It lies in modules of their own (src/mpi), one for each MPI that there
// was at the build, so that nothing else depends on one.
class MpiLibrary {
 public:
  virtual ~MpiLibrary() = default;
  // MPI_COMM_WORLD of the program that was started. MPI is initialized, once, and finalized when
  // the communicator goes.
  virtual std::unique_ptr<Communicator> start() const = 0;
  // A duplicate of the MPI_Comm that lies there, of a program that has initialized MPI; null where
  // it has not. Collective.
  virtual std::unique_ptr<Communicator> ranks_of(const void* communicator) const = 0;
};

// What a module exports.
using MpiLibraryEntry = const MpiLibrary*();
inline constexpr char mpi_library_entry[] = "splotchcl_mpi_library";

// The MPI under which the environment says that this process was started with others: "openmpi",
// "mpich"; empty: none. SPLOTCHCL_MPI says otherwise: one of them, or "none".
std::string mpi_of_environment();

// All processes that were started with this one by mpirun or srun; null where there are no others.
// Throws DataError where the module for their MPI is missing.
std::shared_ptr<Communicator> started_with_mpi();

// Ranks on one host share out its cores: PoCL, which else takes all of them for each process, is
// told how many threads to have, unless the user's environment tells it. Before the first OpenCL
// call.
void share_cores(const Communicator& ranks);

// Of so many cores, of which this process may use `allowed`, each of `ranks` processes takes these.
int cores_of_rank(int cores, int allowed, int ranks);

}  // namespace splotchcl
