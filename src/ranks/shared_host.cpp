#include "ranks/shared_host.h"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <string>

namespace splotchcl {
namespace {

int allowed_cores(int cores) {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (::sched_getaffinity(0, sizeof(set), &set) != 0) return cores;
  return std::max(1, CPU_COUNT(&set));
}

}  // namespace

int cores_of_rank(int cores, int allowed, int ranks) {
  // Where mpirun or Slurm has bound the process to some, these are its share already.
  if (allowed < cores) return allowed;
  return std::max(1, cores / std::max(1, ranks));
}

void share_cores(const Communicator& ranks) {
  const auto cores = static_cast<int>(std::max(1L, ::sysconf(_SC_NPROCESSORS_ONLN)));
  const std::string threads =
      std::to_string(cores_of_rank(cores, allowed_cores(cores), ranks.size_on_host()));
  constexpr int not_over_the_users = 0;
  // The second is its name since PoCL 5.
  ::setenv("POCL_MAX_PTHREAD_COUNT", threads.c_str(), not_over_the_users);
  ::setenv("POCL_CPU_MAX_CU_COUNT", threads.c_str(), not_over_the_users);
}

}  // namespace splotchcl
