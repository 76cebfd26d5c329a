#include "cli/completion.h"

#include <algorithm>

namespace splotchcl::cli {
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

}  // namespace

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

}  // namespace splotchcl::cli
