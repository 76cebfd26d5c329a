#pragma once

#include "cli/command_builder.h"
#include "cli/console.h"

namespace splotchcl::cli {

// Describe `splotchcl galaxy` and `splotchcl evolve`.
void add_galaxy(CLI::App& app, Run& run, Console& console);
void add_evolve(CLI::App& app, Run& run, Console& console);

}  // namespace splotchcl::cli
