// What the program says while it works: -v, -q, and where standard error is no terminal.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "cli/program.h"

namespace splotchcl::test {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* drawing = "render h --reference -o a.png --set 'image.size=[24,16]'";

class Verbosity : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(splotchcl_in(folder_, "generate halo -o h --particles 2000").exit_code, 0);
  }
  TemporaryFolder folder_;
};

TEST_F(Verbosity, TellsEachStepAndTheResultBeforeAndAfterTheCommand) {
  for (const std::string& arguments :
       {std::string("-v ") + drawing, std::string(drawing) + " --verbose"}) {
    const ProgramResult result = splotchcl_in(folder_, arguments);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_THAT(result.err, AllOf(ContainsRegex("splotchcl: [0-9.]+ s: reading h\n"),
                                  ContainsRegex("splotchcl: [0-9.]+ s: drawing 2000 particles\n"),
                                  ContainsRegex("s: a.png: 24x16 pixels, 2000 particles")));
  }
}

TEST_F(Verbosity, TellsNotesUnlessItIsToBeQuiet) {
  std::ofstream(folder_ / "t.csv") << "x,y,z\n1,2,3\n2,3,4\n3,5,4\n";
  const std::string command = "render t.csv --explain";
  EXPECT_THAT(splotchcl_in(folder_, command).err, HasSubstr("note: "));
  EXPECT_EQ(splotchcl_in(folder_, command + " -q").err, "");
  EXPECT_EQ(splotchcl_in(folder_, "--quiet " + command).err, "");
}

TEST_F(Verbosity, TellsErrorsInAnyCase) {
  const ProgramResult result = splotchcl_in(folder_, "-q render missing");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_TRUE(is_one_line(result.err)) << result.err;
}

TEST_F(Verbosity, CannotBeBoth) {
  for (const std::string command : {"-v info h -q", "info h -v -q"}) {
    const ProgramResult result = splotchcl_in(folder_, command);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
  }
}

// The variable stands for the 30 seconds that a test cannot wait.
TEST_F(Verbosity, TellsAPipeFromTimeToTimeWhatTakesLong) {
  const std::string command = "\"$splotchcl\" generate universe -o u --particles 20000";
  const ProgramResult often = run_in(folder_, "SPLOTCHCL_PROGRESS_SECONDS=0.005 " + command);
  ASSERT_EQ(often.exit_code, 0) << often.err;
  EXPECT_THAT(often.err, ContainsRegex("splotchcl: [0-9]+ s: making 20000 particles\n"));
  const ProgramResult quiet =
      run_in(folder_, "SPLOTCHCL_PROGRESS_SECONDS=0.005 " + command + " -q");
  EXPECT_EQ(quiet.err, "");
  EXPECT_THAT(run_in(folder_, "SPLOTCHCL_PROGRESS_SECONDS=x " + command).err,
              Not(HasSubstr(" s: ")));
}

}  // namespace
}  // namespace splotchcl::test
