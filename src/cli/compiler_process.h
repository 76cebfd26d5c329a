#pragma once

#include <memory>

#include "splotchcl/communicator.h"
#include "splotchcl/program_compiler.h"

// Processes of this program that compile for another one.
namespace splotchcl::cli {

// The command by which it starts itself.
inline constexpr char compiler_command[] = "compile-for-another";

// A way to start such processes, for the command line alone: a library must not start its caller's
// program. Where several processes draw together there is none.
StartCompiler compiler_processes(const std::shared_ptr<Communicator>& ranks = nullptr);

// The process itself: compiles what is asked for on its standard input, a socket on which it also
// answers, until that is closed: by the other process, or because it has ended.
int run_compiler();

}  // namespace splotchcl::cli
