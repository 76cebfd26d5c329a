#include "cli/pages.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>
#include <string>
#include <system_error>

#include "common/unfinished_file.h"
#include "splotchcl/error.h"

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

namespace {

// Of options: what follows them is completed by names of files, or not at all.
bool takes_file(const OptionWords& option) {
  return option.value == "FILE" || option.value == "SCENE";
}

std::string words_of(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words)
    text += (text.empty() ? "" : " ") + word;
  return text;
}

std::string names_of(const std::vector<OptionWords>& options) {
  std::string text;
  for (const OptionWords& option : options)
    text += (text.empty() ? "" : " ") + words_of(option.names);
  return text;
}

std::string command_names(const CommandTree& tree) {
  std::string text;
  for (const CommandWords& command : tree.commands)
    text += (text.empty() ? "" : " ") + command.name;
  return text;
}

std::string choices_of(const CommandWords& command) {
  return command.arguments.empty() ? "" : words_of(command.arguments.front().choices);
}

// Options after which a word follows that no list knows, for a pattern of the shell.
std::string wordy_options(const CommandWords& command) {
  std::string text;
  for (const OptionWords& option : command.options) {
    if (option.value.empty() || takes_file(option)) continue;
    for (const std::string& name : option.names)
      text += (text.empty() ? "" : "|") + name;
  }
  return text;
}

// In single quotes of a shell.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'') {
      result += "'\\''";
    } else {
      result += c;
    }
  }
  return result + "'";
}

// Lists are short: what help says up to its first break.
std::string in_short(const std::string& help) {
  return help.substr(0, help.find_first_of(".;:"));
}

std::string bash_case(const CommandWords& command) {
  std::string text =
      "    " + command.name + ")\n      options=" + quoted(names_of(command.options));
  text += "\n      choices=" + quoted(choices_of(command)) + '\n';
  const std::string wordy = wordy_options(command);
  if (!wordy.empty()) {
    text += "      case \"$before\" in\n        " + wordy + ") return ;;\n      esac\n";
  }
  return text + "      ;;\n";
}

// As zsh's _arguments takes them: brackets, colons and backslashes have a meaning there.
std::string zsh_text(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
    result += c;
  }
  return result;
}

std::string zsh_values(const OptionWords& option) {
  if (option.value.empty()) return "";
  return ":" + zsh_text(option.value) + ":" + (takes_file(option) ? "_files" : "");
}

std::string zsh_command(const CommandWords& command) {
  std::string text = "    " + command.name + ")\n      _arguments -s";
  for (const OptionWords& option : command.options) {
    for (const std::string& name : option.names) {
      text += " \\\n        " +
              quoted("*" + name + "[" + zsh_text(in_short(option.help)) + "]" + zsh_values(option));
    }
  }
  for (const ArgumentWords& argument : command.arguments) {
    const std::string values =
        argument.choices.empty() ? "_files" : "(" + words_of(argument.choices) + ")";
    text += " \\\n        " + quoted("*:" + zsh_text(argument.name) + ":" + values);
    break;  // files, however many
  }
  return text + "\n      ;;\n";
}

std::string fish_option(const std::string& condition, const OptionWords& option) {
  std::string text = "complete -c splotchcl -n " + quoted(condition);
  for (const std::string& name : option.names)
    text += (name.size() == 2 ? " -s " : " -l ") + name.substr(name.size() == 2 ? 1 : 2);
  if (!option.value.empty()) text += takes_file(option) ? " -r -F" : " -x";
  return text + " -d " + quoted(in_short(option.help)) + '\n';
}

// What shells need to complete the program's commands, options, choices and files.
std::string bash_completion(const CommandTree& tree) {
  std::string text =
      "# Completion of splotchcl for bash.\n"
      "_splotchcl() {\n"
      "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}\n"
      "  local command='' options='' choices='' i\n"
      "  COMPREPLY=()\n"
      "  for ((i = 1; i < COMP_CWORD; ++i)); do\n"
      "    if [[ ${COMP_WORDS[i]} != -* ]]; then command=${COMP_WORDS[i]}; break; fi\n"
      "  done\n"
      "  case \"$command\" in\n"
      "    '')\n      options=" +
      quoted(names_of(tree.program.options)) + "\n      choices=" + quoted(command_names(tree)) +
      "\n      ;;\n";
  for (const CommandWords& command : tree.commands)
    text += bash_case(command);
  return text +
         "  esac\n"
         "  if [[ $word == -* ]]; then\n"
         "    COMPREPLY=($(compgen -W \"$options\" -- \"$word\"))\n"
         "  elif [[ -n $choices && $before != -o && $before != --output ]]; then\n"
         "    COMPREPLY=($(compgen -W \"$choices\" -- \"$word\"))\n"
         "  else\n"
         "    local IFS=$'\\n'\n"
         "    COMPREPLY=($(compgen -f -- \"$word\"))\n"
         "  fi\n"
         "}\n"
         "complete -o filenames -F _splotchcl splotchcl\n";
}

std::string zsh_completion(const CommandTree& tree) {
  std::string text =
      "#compdef splotchcl\n"
      "# Completion of splotchcl for zsh.\n"
      "_splotchcl() {\n"
      "  local curcontext=$curcontext state line\n"
      "  local -a commands=(\n";
  for (const CommandWords& command : tree.commands)
    text += "    " + quoted(command.name + ":" + zsh_text(in_short(command.help))) + '\n';
  text += "  )\n  _arguments -C";
  for (const OptionWords& option : tree.program.options) {
    for (const std::string& name : option.names)
      text += " \\\n    " + quoted(name + "[" + zsh_text(in_short(option.help)) + "]");
  }
  text +=
      " \\\n    '1: :->command' \\\n    '*:: :->arguments'\n"
      "  if [[ $state == command ]]; then\n"
      "    _describe command commands\n"
      "    return\n"
      "  fi\n"
      "  case $line[1] in\n";
  for (const CommandWords& command : tree.commands)
    text += zsh_command(command);
  return text + "  esac\n}\n_splotchcl \"$@\"\n";
}

std::string fish_completion(const CommandTree& tree) {
  std::string text = "# Completion of splotchcl for fish.\n";
  for (const OptionWords& option : tree.program.options)
    text += fish_option("__fish_use_subcommand", option);
  for (const CommandWords& command : tree.commands) {
    text += "complete -c splotchcl -n '__fish_use_subcommand' -f -a " + command.name + " -d " +
            quoted(in_short(command.help)) + '\n';
    const std::string here = "__fish_seen_subcommand_from " + command.name;
    for (const OptionWords& option : command.options)
      text += fish_option(here, option);
    const std::string choices = choices_of(command);
    if (!choices.empty())
      text += "complete -c splotchcl -n " + quoted(here) + " -f -a " + quoted(choices) + '\n';
  }
  return text;
}

// Text as it is: backslashes and hyphens have a meaning, and so have a dot and a quote at the start
// of a line.
std::string plain(const std::string& text) {
  std::string result;
  bool starts_line = true;
  for (const char c : text) {
    if (starts_line && (c == '.' || c == '\'')) result += "\\&";
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else {
      result += c;
    }
    starts_line = c == '\n';
  }
  return result;
}

std::string bold(const std::string& text) {
  return "\\fB" + plain(text) + "\\fR";
}

std::string italic(const std::string& text) {
  return "\\fI" + plain(text) + "\\fR";
}

std::string sentence(const std::string& text) {
  return text.empty() || text.back() == '.' ? text : text + ".";
}

std::string title(const std::string& name, const std::string& source) {
  return ".TH \"" + plain(name) + "\" 1 \"\" \"" + plain(source) + "\" \"User Commands\"\n";
}

std::string name_section(const std::string& name, std::string help) {
  while (!help.empty() && help.back() == '.')
    help.pop_back();
  // What follows a dash.
  if (!help.empty() && help.front() >= 'A' && help.front() <= 'Z') help.front() += 'a' - 'A';
  return ".SH NAME\n" + plain(name) + " \\- " + plain(help) + '\n';
}

std::string describe(const OptionWords& option) {
  std::string text = ".TP\n";
  for (std::size_t i = 0; i < option.names.size(); ++i)
    text += (i > 0 ? ", " : "") + bold(option.names[i]);
  if (!option.value.empty()) text += ' ' + italic(option.value);
  text += '\n' + plain(sentence(option.help));
  if (option.is_required) text += " Needed.";
  if (!option.standard.empty()) text += " Default: " + plain(option.standard) + '.';
  return text + '\n';
}

std::string describe(const ArgumentWords& argument) {
  return ".TP\n" + italic(argument.name) + '\n' + plain(sentence(argument.help)) + '\n';
}

std::string options_section(const CommandWords& command) {
  std::string text = ".SH OPTIONS\n";
  for (const OptionWords& option : command.options)
    text += describe(option);
  return text;
}

std::string synopsis(const CommandWords& command) {
  std::string text = bold("splotchcl " + command.name);
  for (const OptionWords& option : command.options) {
    if (option.is_required) text += ' ' + bold(option.names.front()) + ' ' + italic(option.value);
  }
  text += " [" + italic("OPTION") + "]...";
  for (const ArgumentWords& argument : command.arguments) {
    const std::string name = italic(argument.name);
    text += ' ' + (argument.is_required ? name : '[' + name + ']');
  }
  return ".SH SYNOPSIS\n" + text + '\n';
}

std::string exit_section() {
  return ".SH EXIT STATUS\n.TP\n0\nDone.\n.TP\n1\nThe data or the device failed.\n.TP\n2\nThe call "
         "or the scene is wrong.\n";
}

std::string examples_section(const CommandWords& command) {
  if (command.examples.empty()) return "";
  std::string text = ".SH EXAMPLES\n.nf\n";
  for (const std::string& example : command.examples)
    text += plain(example) + '\n';
  return text + ".fi\n";
}

std::string page_of(const std::string& command) {
  return bold("splotchcl-" + command) + "(1)";
}

// Manual pages in the language of man(7): of the program, and of one of its commands. `source` is
// the program and its version.
std::string program_page(const CommandTree& tree, const std::string& source) {
  std::string text = title("SPLOTCHCL", source) + name_section("splotchcl", tree.program.help);
  text += ".SH SYNOPSIS\n" + bold("splotchcl") + ' ' + italic("COMMAND") + " [" +
          italic("ARGUMENT") + "]...\n";
  text += ".SH DESCRIPTION\n" + plain(tree.program.remarks) + ".SH COMMANDS\n";
  std::string pages;
  for (const CommandWords& command : tree.commands) {
    text += ".TP\n" + page_of(command.name) + '\n' + plain(sentence(command.help)) + '\n';
    pages += (pages.empty() ? "" : ",\n") + page_of(command.name);
  }
  return text + options_section(tree.program) + exit_section() + ".SH SEE ALSO\n" + pages + '\n';
}

std::string command_page(const CommandWords& command, const std::string& source) {
  const std::string name = "splotchcl-" + command.name;
  std::string text = title(name, source) + name_section(name, command.help) + synopsis(command);
  text += ".SH DESCRIPTION\n";
  text += plain(command.remarks.empty() ? sentence(command.help) + '\n' : command.remarks);
  for (const ArgumentWords& argument : command.arguments)
    text += describe(argument);
  return text + options_section(command) + exit_section() + examples_section(command) +
         ".SH SEE ALSO\n" + bold("splotchcl") + "(1)\n";
}

constexpr char source[] = "splotchcl " SPLOTCHCL_VERSION;

void write(const std::filesystem::path& path, const std::string& text) {
  std::error_code error;
  std::filesystem::create_directories(path.parent_path(), error);
  if (error) {
    throw DataError(path.parent_path().string() + ": " + error.message() +
                    ", expected a folder that can be made");
  }
  UnfinishedFile file(path);
  file.write(text.data(), text.size());
  file.finish();
}

}  // namespace

int write_pages(const CommandTree& tree, const std::filesystem::path& folder) {
  write(folder / "man1" / "splotchcl.1", program_page(tree, source));
  for (const CommandWords& command : tree.commands)
    write(folder / "man1" / ("splotchcl-" + command.name + ".1"), command_page(command, source));
  write(folder / "bash" / "splotchcl", bash_completion(tree));
  write(folder / "zsh" / "_splotchcl", zsh_completion(tree));
  write(folder / "fish" / "splotchcl.fish", fish_completion(tree));
  return 0;
}

}  // namespace splotchcl::cli
