#pragma once

#include "cli/command_builder.h"
#include "cli/console.h"

namespace splotchcl::cli {

void add_view(CLI::App& app, Run& run, Console& console);

}  // namespace splotchcl::cli
