#include "ranks/mpi_library.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "modules/module_file.h"
#include "splotchcl/error.h"
#include "system/system.h"

namespace splotchcl {
namespace {

std::string variable(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? "" : value;
}

bool is_above_one(const std::string& number) {
  return std::strtol(number.c_str(), nullptr, 10) > 1;
}

// `why` ends with a word for the MPI.
const MpiLibrary& load(const std::string& mpi, const std::string& why, const std::string& advice) {
  // Open MPI's own plugins look for its functions among what is global.
  void* const entry = module_entry("libsplotchcl_" + mpi + ".so", mpi_library_entry,
                                   why + ", which needs", advice, ModuleSymbols::global);
  return *reinterpret_cast<MpiLibraryEntry*>(entry)();
}

}  // namespace

std::string mpi_of_environment() {
  const std::string chosen = variable("SPLOTCHCL_MPI");
  if (chosen == "none") return "";
  if (chosen == "openmpi" || chosen == "mpich") return chosen;
  if (!chosen.empty()) {
    throw UsageError("SPLOTCHCL_MPI: found '" + chosen + "', expected openmpi, mpich or none");
  }
  if (is_above_one(variable("OMPI_COMM_WORLD_SIZE"))) return "openmpi";
  // Hydra and Slurm's PMI.
  if (is_above_one(variable("PMI_SIZE"))) return "mpich";
  // srun --mpi=pmix.
  if (!variable("PMIX_RANK").empty() && is_above_one(variable("SLURM_NTASKS"))) return "openmpi";
  return "";
}

std::shared_ptr<Communicator> started_with_mpi() {
  const std::string mpi = mpi_of_environment();
  if (mpi.empty()) return nullptr;
  std::shared_ptr<Communicator> ranks =
      load(mpi, "started by an MPI (" + mpi + ") with other processes",
           "install it beside the program, or let each process draw by itself with "
           "SPLOTCHCL_MPI=none")
          .start();
  return ranks->size() > 1 ? ranks : nullptr;
}

std::shared_ptr<Communicator> ranks_of_mpi(const std::string& mpi, const void* communicator) {
  if (mpi != "openmpi" && mpi != "mpich") {
    throw UsageError("a communicator of MPI: found " + mpi +
                     ", expected openmpi or mpich; with another one derive a class from "
                     "splotchcl::Communicator");
  }
  if (communicator == nullptr) throw UsageError("the communicator of MPI is a null pointer");
  std::shared_ptr<Communicator> ranks =
      load(mpi, "given a communicator of an MPI (" + mpi + ")",
           "build splotchcl where this MPI is installed, and install the module beside it")
          .ranks_of(communicator);
  if (!ranks) {
    throw UsageError("a communicator of MPI (" + mpi +
                     "): found that MPI has not been initialized, or is another one, expected "
                     "this one; call MPI_Init before");
  }
  share_cores(*ranks);
  return ranks;
}

int cores_of_rank(int cores, int allowed, int ranks) {
  // Where mpirun or Slurm has bound the process to some, these are its share already.
  if (allowed < cores) return allowed;
  return std::max(1, cores / std::max(1, ranks));
}

void share_cores(const Communicator& ranks) {
  const auto cores = static_cast<int>(std::max(1L, ::sysconf(_SC_NPROCESSORS_ONLN)));
  const std::string threads = std::to_string(
      cores_of_rank(cores, of_system::allowed_cores().value_or(cores), ranks.size_on_host()));
  constexpr int not_over_the_users = 0;
  // The second is its name since PoCL 5.
  ::setenv("POCL_MAX_PTHREAD_COUNT", threads.c_str(), not_over_the_users);
  ::setenv("POCL_CPU_MAX_CU_COUNT", threads.c_str(), not_over_the_users);
}

}  // namespace splotchcl
