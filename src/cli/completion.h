#pragma once

#include <string>

#include "cli/command_tree.h"

namespace splotchcl::cli {

// What shells need to complete the program's commands, options, choices and files.
std::string bash_completion(const CommandTree& tree);
std::string zsh_completion(const CommandTree& tree);
std::string fish_completion(const CommandTree& tree);

}  // namespace splotchcl::cli
