#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace CLI {
class App;
}

// What the command line takes, for what is made of it: manual pages and completion.
namespace splotchcl::cli {

struct OptionWords {
  std::vector<std::string> names;  // "-o", "--output"
  std::string value;               // "FILE"; empty: a flag
  std::string standard;            // the value where it is not given; empty: none, or not known
  std::string help;                // in one line
  bool is_required = false;
};

struct ArgumentWords {
  std::string name;                  // "SCENE"
  std::vector<std::string> choices;  // empty: a file, or any word
  std::string help;
  bool is_required = false;
};

struct CommandWords {
  std::string name;  // of the program itself: empty
  std::string help;
  std::string remarks;                // whole sentences, with lines as they are
  std::vector<std::string> examples;  // commands, a line each
  std::vector<ArgumentWords> arguments;
  std::vector<OptionWords> options;
};

struct CommandTree {
  CommandWords program;
  std::vector<CommandWords> commands;  // but for hidden ones
};

CommandTree describe_commands(const CLI::App& app);

// Writes what belongs to the installed program below a folder: man1/, bash/, zsh/, fish/. Throws
// DataError. The build calls it as the hidden command `pages FOLDER`.
int write_pages(const CommandTree& tree, const std::filesystem::path& folder);

}  // namespace splotchcl::cli
