#pragma once

#include "cli/command_builder.h"
#include "cli/console.h"

namespace splotchcl::cli {

// Describe `splotchcl info`, `fields` and `palettes`: what a snapshot holds, and the names that
// scenes may use.
void add_info(CLI::App& app, Run& run, Console& console);
void add_index(CLI::App& app, Run& run, Console& console);
void add_fields(CLI::App& app, Run& run, Console& console);
void add_palettes(CLI::App& app, Run& run, Console& console);

}  // namespace splotchcl::cli
