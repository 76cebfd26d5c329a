#include <mpi.h>

#include "mpi/mpi_ranks.h"
#include "ranks/mpi_library.h"

namespace splotchcl {
namespace {

class Mpi final : public MpiLibrary {
 public:
  std::unique_ptr<Communicator> start() const override {
    int provided = 0;
    // Other threads write files and compile kernels; one of them calls MPI.
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    return mpi_ranks(MPI_COMM_WORLD, true);
  }
  std::unique_ptr<Communicator> ranks_of(const void* communicator) const override {
    int is_initialized = 0;
    MPI_Initialized(&is_initialized);
    if (is_initialized == 0) return nullptr;
    return mpi_ranks(*static_cast<const MPI_Comm*>(communicator), false);
  }
};

}  // namespace
}  // namespace splotchcl

extern "C" __attribute__((visibility("default"))) const splotchcl::MpiLibrary*
splotchcl_mpi_library() {
  static const splotchcl::Mpi library;
  return &library;
}
