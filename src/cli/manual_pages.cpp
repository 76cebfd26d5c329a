#include "cli/manual_pages.h"

#include <sstream>

namespace splotchcl::cli {
namespace {

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

}  // namespace

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

}  // namespace splotchcl::cli
