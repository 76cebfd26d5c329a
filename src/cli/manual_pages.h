#pragma once

#include <string>

#include "cli/command_tree.h"

namespace splotchcl::cli {

// Manual pages in the language of man(7): of the program, and of one of its commands. `source` is
// the program and its version.
std::string program_page(const CommandTree& tree, const std::string& source);
std::string command_page(const CommandWords& command, const std::string& source);

}  // namespace splotchcl::cli
