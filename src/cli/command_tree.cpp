#include "cli/command_tree.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>

namespace splotchcl::cli {
namespace {

// Help is wrapped for terminals.
std::string in_one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

// "TEXT:{universe,halo}", as CLI11 writes what a value must be one of.
std::vector<std::string> choices_of(const std::string& type_name) {
  std::vector<std::string> choices;
  const std::size_t begin = type_name.find('{'), end = type_name.rfind('}');
  if (begin == std::string::npos || end == std::string::npos) return choices;
  std::istringstream words(type_name.substr(begin + 1, end - begin - 1));
  for (std::string word; std::getline(words, word, ',');)
    choices.push_back(word);
  return choices;
}

ArgumentWords describe_argument(const CLI::Option& option) {
  return {option.get_name(true), choices_of(option.get_type_name()),
          in_one_line(option.get_description()), option.get_required()};
}

OptionWords describe_option(const CLI::Option& option) {
  OptionWords words;
  for (const std::string& name : option.get_snames())
    words.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames())
    words.names.push_back("--" + name);
  if (option.get_items_expected_max() > 0) {
    words.value = option.get_type_name();
    words.standard = option.get_default_str();
  }
  words.help = in_one_line(option.get_description());
  words.is_required = option.get_required();
  return words;
}

// The footer of a command ends with its examples.
void split_footer(const std::string& footer, CommandWords& words) {
  std::istringstream lines(footer);
  bool is_example = false;
  for (std::string line; std::getline(lines, line);) {
    if (line == "Example:" || line == "Examples:") {
      is_example = true;
    } else if (is_example) {
      words.examples.push_back(line.substr(std::min(line.size(), line.find_first_not_of(' '))));
    } else {
      words.remarks += line + '\n';
    }
  }
}

CommandWords describe_command(const CLI::App& app) {
  CommandWords words;
  words.help = app.get_description();
  split_footer(app.get_footer(), words);
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_positional()) {
      words.arguments.push_back(describe_argument(*option));
    } else {
      words.options.push_back(describe_option(*option));
    }
  }
  return words;
}

bool is_shown(const CLI::App* command) {
  return !command->get_group().empty();
}

}  // namespace

CommandTree describe_commands(const CLI::App& app) {
  CommandTree tree;
  tree.program = describe_command(app);
  for (const CLI::App* command : app.get_subcommands(is_shown)) {
    tree.commands.push_back(describe_command(*command));
    tree.commands.back().name = command->get_name();
  }
  return tree;
}

}  // namespace splotchcl::cli
