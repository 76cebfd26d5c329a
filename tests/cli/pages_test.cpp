// Manual pages and completion say what the commands take: the build makes them of the same tree.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include "cli/program.h"

namespace splotchcl::test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::UnorderedElementsAre;

// The first words of the lines of help below "Subcommands:".
std::vector<std::string> commands_in_help(const TemporaryFolder& folder) {
  std::istringstream help(splotchcl_in(folder, "--help").out);
  std::vector<std::string> commands;
  bool is_listed = false;
  for (std::string line; std::getline(help, line);) {
    if (line.rfind("  ", 0) == 0 && line.size() > 2 && line[2] != ' ' && is_listed) {
      commands.push_back(line.substr(2, line.find(' ', 2) - 2));
    } else if (line.empty() || line.back() == ':') {
      is_listed = line == "Subcommands:";
    }
  }
  return commands;
}

// "-o,--output FILE" and the like at the start of lines of help.
std::set<std::string> options_in_help(const TemporaryFolder& folder, const std::string& command) {
  std::istringstream help(splotchcl_in(folder, command + " --help").out);
  std::set<std::string> options;
  for (std::string line; std::getline(help, line);) {
    if (line.rfind("  -", 0) != 0) continue;
    std::istringstream names(line.substr(2, line.find_first_of(" {=", 2) - 2));
    for (std::string name; std::getline(names, name, ',');)
      options.insert(name);
  }
  return options;
}

std::string escaped(const std::string& option) {
  std::string text;
  for (const char c : option)
    text += c == '-' ? std::string("\\-") : std::string(1, c);
  return "\\fB" + text + "\\fR";
}

class Pages : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(splotchcl_in(folder_, "pages .").exit_code, 0); }
  std::string page(const std::string& command) const {
    return read_text(folder_ / "man1" / ("splotchcl-" + command + ".1"));
  }
  // What bash offers where the last word is to be completed.
  std::set<std::string> complete(const std::string& words) const {
    const ProgramResult result = run_in(
        folder_, "bash -c 'source bash/splotchcl; COMP_WORDS=(" + words +
                     "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _splotchcl; printf \"%s\\n\" "
                     "\"${COMPREPLY[@]}\"'");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    std::set<std::string> offered;
    std::istringstream lines(result.out);
    for (std::string line; std::getline(lines, line);)
      if (!line.empty()) offered.insert(line);
    return offered;
  }
  bool can_run(const std::string& program) const {
    return run_in(folder_, "command -v " + program).exit_code == 0;
  }

  const TemporaryFolder folder_;
};

TEST_F(Pages, AreThereForEveryCommand) {
  const std::vector<std::string> commands = commands_in_help(folder_);
  EXPECT_GT(commands.size(), 10U);
  for (const std::string& command : commands) {
    EXPECT_THAT(page(command), HasSubstr(".SH OPTIONS")) << command;
    EXPECT_THAT(read_text(folder_ / "man1" / "splotchcl.1"), HasSubstr("splotchcl\\-" + command));
  }
}

TEST_F(Pages, AreNotOfAHiddenCommand) {
  EXPECT_FALSE(std::filesystem::exists(folder_ / "man1" / "splotchcl-pages.1"));
  EXPECT_THAT(splotchcl_in(folder_, "--help").out, Not(HasSubstr("pages")));
}

TEST_F(Pages, NameEveryOptionOfTheHelp) {
  for (const std::string& command : commands_in_help(folder_)) {
    const std::set<std::string> options = options_in_help(folder_, command);
    EXPECT_GE(options.size(), 4U) << command;
    for (const std::string& option : options)
      EXPECT_THAT(page(command), HasSubstr(escaped(option))) << command;
  }
}

TEST_F(Pages, AreReadWithoutAWarning) {
  if (!can_run("groff")) GTEST_SKIP() << "no groff here";
  const ProgramResult result = run_in(folder_, "groff -man -Tutf8 -ww -z man1/*.1");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, IsEmpty());
}

TEST_F(Pages, LetBashCompleteCommands) {
  EXPECT_THAT(complete("splotchcl pa"), UnorderedElementsAre("palettes", "path"));
}

TEST_F(Pages, LetBashCompleteEveryOption) {
  for (const std::string& command : commands_in_help(folder_)) {
    const std::set<std::string> offered = complete("splotchcl " + command + " -");
    EXPECT_EQ(offered, options_in_help(folder_, command)) << command;
  }
}

TEST_F(Pages, LetBashCompleteChoicesAndFiles) {
  EXPECT_THAT(complete("splotchcl generate h"), UnorderedElementsAre("halo"));
  ASSERT_EQ(run_in(folder_, "touch scene.toml").exit_code, 0);
  EXPECT_THAT(complete("splotchcl render scene"), UnorderedElementsAre("scene.toml"));
  EXPECT_THAT(complete("splotchcl render a --stats scene"), UnorderedElementsAre("scene.toml"));
}

TEST_F(Pages, LetBashOfferNoFilesAsANumber) {
  ASSERT_EQ(run_in(folder_, "touch 1.toml").exit_code, 0);
  EXPECT_THAT(complete("splotchcl render a --tolerance 1"), IsEmpty());
}

TEST_F(Pages, LetZshCompleteCommands) {
  if (!can_run("zsh")) GTEST_SKIP() << "no zsh here";
  const ProgramResult result = run_in(folder_, "zsh -n zsh/_splotchcl");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const std::string& option : options_in_help(folder_, "render"))
    EXPECT_THAT(read_text(folder_ / "zsh" / "_splotchcl"), HasSubstr("*" + option + "["));
}

TEST_F(Pages, LetFishCompleteOptions) {
  if (!can_run("fish")) GTEST_SKIP() << "no fish here";
  const ProgramResult result = run_in(
      folder_,
      "HOME=$PWD fish -c 'source fish/splotchcl.fish; complete -C \"splotchcl render --to\"'");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("--tolerance"));
}

TEST_F(Pages, AreNotWrittenWhereNoFolderCanBe) {
  ASSERT_EQ(run_in(folder_, "touch file").exit_code, 0);
  const ProgramResult result = splotchcl_in(folder_, "pages file");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_TRUE(is_one_line(result.err)) << result.err;
}

}  // namespace
}  // namespace splotchcl::test
