#pragma once

#include <memory>
#include <string>

#include "cli/console.h"
#include "splotchcl/communicator.h"
#include "splotchcl/program_compiler.h"

// Several processes that were started together, by mpirun or srun (docs/large.md).
namespace splotchcl::cli {

// All of them, where there are others: they share out the cores of each host, only the first tells
// anything but errors, and all must be of one version. Null: this process alone. Before the first
// OpenCL call; the same for each call.
std::shared_ptr<Communicator> join_processes(Console& console);

// The first of the processes, or the only one: it has the files that are written.
bool writes_files(const std::shared_ptr<Communicator>& ranks);

// Throws UsageError where there are others: of what one process does alone.
void expect_one_process(const Communicator* ranks, const std::string& option);

// This process ends with this code, and with it all others: where they have not agreed upon that,
// they may wait for this one.
void leave_processes(int code, bool is_agreed);

// The command by which this program starts itself, to compile for another process of it.
inline constexpr char compiler_command[] = "compile-for-another";

// A way to start such processes, for the command line alone: a library must not start its caller's
// program. Where several processes draw together there is none.
StartCompiler compiler_processes(const std::shared_ptr<Communicator>& ranks = nullptr);

// The process itself: compiles what is asked for on its standard input, a socket on which it also
// answers, until that is closed: by the other process, or because it has ended.
int run_compiler();

}  // namespace splotchcl::cli
