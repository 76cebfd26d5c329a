#pragma once

#include "cli/console.h"

namespace splotchcl::cli {

// Carries out what the arguments ask for. The result is the exit code. Throws UsageError
// for arguments that cannot be understood.
int run_command_line(int argc, char** argv, Console& console);

}  // namespace splotchcl::cli
