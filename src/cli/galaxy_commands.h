#pragma once

#include "cli/command_builder.h"
#include "cli/console.h"

namespace splotchcl::cli {

// Describes `splotchcl galaxy`.
void add_galaxy(CLI::App& app, Run& run, Console& console);

}  // namespace splotchcl::cli
