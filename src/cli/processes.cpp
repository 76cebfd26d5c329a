#include "cli/processes.h"

#include "cli/version.h"
#include "common/crash_guard.h"
#include "ranks/exchange.h"
#include "ranks/mpi_library.h"
#include "splotchcl/error.h"

namespace splotchcl::cli {
namespace {

struct Processes {
  bool are_joined = false;
  std::shared_ptr<Communicator> ranks;
};

Processes& processes() {
  static Processes all;
  return all;
}

}  // namespace

std::shared_ptr<Communicator> join_processes(Console& console) {
  Processes& all = processes();
  if (all.are_joined) return all.ranks;
  all.are_joined = true;
  all.ranks = started_with_mpi();
  if (!all.ranks) return nullptr;
  share_cores(*all.ranks);
  if (all.ranks->rank() > 0) console.set_verbosity(Verbosity::quiet);
  require_same(*all.ranks, "version", version_and_commit(), "install the same version everywhere");
  return all.ranks;
}

bool writes_files(const std::shared_ptr<Communicator>& ranks) {
  return !ranks || ranks->rank() == 0;
}

void expect_one_process(const Communicator* ranks, const std::string& option) {
  if (ranks == nullptr) return;
  throw UsageError(option + ": found " + std::to_string(ranks->size()) +
                   " processes, expected one: it draws alone");
}

void leave_processes(int code, bool is_agreed) {
  Processes& all = processes();
  if (!all.ranks) return;
  let_libraries_exit();
  if (!is_agreed) all.ranks->abort(code);
  all.ranks.reset();
}

}  // namespace splotchcl::cli
