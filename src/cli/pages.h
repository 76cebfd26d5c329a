#pragma once

#include <filesystem>

#include "cli/command_tree.h"

namespace splotchcl::cli {

// Writes what belongs to the installed program below a folder: man1/, bash/, zsh/, fish/. Throws
// DataError. The build calls it as the hidden command `pages FOLDER`.
int write_pages(const CommandTree& tree, const std::filesystem::path& folder);

}  // namespace splotchcl::cli
