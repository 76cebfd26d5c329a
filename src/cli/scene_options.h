#pragma once

#include "cli/commands.h"

namespace CLI {
class App;
}

namespace splotchcl::cli {

// What render, movie and map take alike: which particles are shown, how they are read, and with
// what.
void add_scene_options(CLI::App& sub, DrawOptions& options);
// The same without --reference, for what must be quick.
void add_live_options(CLI::App& sub, DrawOptions& options);

}  // namespace splotchcl::cli
