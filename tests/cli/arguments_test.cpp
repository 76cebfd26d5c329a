// What the program says to calls that are wrong, and to those that ask for help.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/program.h"

namespace splotchcl::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

// A wrong call ends with 2, one line on standard error, and nothing else.
void expect_wrong_call(const ProgramResult& result) {
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_TRUE(is_one_line(result.err)) << result.err;
  EXPECT_THAT(result.err, StartsWith("splotchcl: "));
  EXPECT_EQ(result.out, "");
}

TEST(Arguments, NamesEveryCommandInItsHelp) {
  const TemporaryFolder folder;
  const ProgramResult result = splotchcl_in(folder, "--help");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(result.out, AllOf(HasSubstr("render"), HasSubstr("info"), HasSubstr("compare"),
                                HasSubstr("devices"), HasSubstr("generate"), HasSubstr("fields"),
                                HasSubstr("palettes")));
}

TEST(Arguments, AreNotNeededForHelp) {
  const TemporaryFolder folder;
  const ProgramResult result = splotchcl_in(folder, "");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(result.out, splotchcl_in(folder, "--help").out);
  EXPECT_THAT(result.out, HasSubstr("  splotchcl render snapshot_006 -o picture.png"));
}

TEST(Arguments, AreNotOnlyVerbosity) {
  const TemporaryFolder folder;
  expect_wrong_call(splotchcl_in(folder, "--quiet"));
}

class Commands : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Arguments, Commands,
                         ::testing::Values("render", "info", "fields", "palettes", "compare",
                                           "devices", "generate"));

TEST_P(Commands, HaveHelpWithAnExample) {
  const TemporaryFolder folder;
  const ProgramResult result = splotchcl_in(folder, std::string(GetParam()) + " --help");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(result.out, AllOf(HasSubstr("Example"), HasSubstr("  splotchcl ")));
}

TEST(Arguments, AreDescribedWithoutMarksOfTheirParser) {
  const TemporaryFolder folder;
  for (const std::string command : {"render", "movie", "galaxy"}) {
    const std::string help = splotchcl_in(folder, command + " --help").out;
    for (const char* const mark : {"->", "{false}", "(=1000b)"})
      EXPECT_THAT(help, Not(HasSubstr(mark))) << command;
  }
}

TEST_P(Commands, SuggestTheOptionThatWasMeant) {
  const TemporaryFolder folder;
  const ProgramResult result = splotchcl_in(folder, std::string(GetParam()) + " --halp");
  expect_wrong_call(result);
  EXPECT_THAT(result.err, AllOf(HasSubstr("--halp"), HasSubstr("did you mean --help?")));
}

TEST(Arguments, TellTheVersion) {
  const TemporaryFolder folder;
  const ProgramResult result = splotchcl_in(folder, "--version");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, StartsWith("splotchcl "));
  EXPECT_THAT(result.out, AllOf(HasSubstr("\nOpenCL loader: "), HasSubstr("libOpenCL"),
                                HasSubstr("HDF5 1."), HasSubstr("OpenEXR ")));
}

TEST(Arguments, OfCommandsAreNeeded) {
  const TemporaryFolder folder;
  expect_wrong_call(splotchcl_in(folder, "render"));
  expect_wrong_call(splotchcl_in(folder, "info"));
  expect_wrong_call(splotchcl_in(folder, "compare a.png"));
  expect_wrong_call(splotchcl_in(folder, "generate universe"));
}

TEST(Arguments, SuggestTheCommandThatWasMeant) {
  const TemporaryFolder folder;
  const ProgramResult result = splotchcl_in(folder, "rnder snapshot");
  expect_wrong_call(result);
  EXPECT_THAT(result.err, AllOf(HasSubstr("'rnder'"), HasSubstr("did you mean render?")));
}

TEST(Arguments, SuggestRenderForAFileWithoutACommand) {
  const TemporaryFolder folder;
  const ProgramResult result = run_in(folder, "touch snapshot; \"$splotchcl\" snapshot");
  expect_wrong_call(result);
  EXPECT_THAT(result.err, HasSubstr("splotchcl render snapshot"));
}

TEST(Arguments, SuggestTheRenderOptionThatWasMeant) {
  const TemporaryFolder folder;
  const ProgramResult result = splotchcl_in(folder, "render snapshot --tolerence=0.1");
  expect_wrong_call(result);
  EXPECT_THAT(result.err, HasSubstr("did you mean --tolerance?"));
}

TEST(Arguments, MustBeNumbersWhereNumbersAreExpected) {
  const TemporaryFolder folder;
  for (const char* arguments :
       {"render x --tolerance abc", "render x --crop 1,2,3", "render x --crop 1,2,3,4,5",
        "render x --crop 1,2,3,x", "compare a.png b.png --limit high",
        "compare a.png b.png --limit=-1", "compare a.png b.png --limit nan",
        "generate universe -o u --particles many", "generate universe -o u --particles=-5"}) {
    SCOPED_TRACE(arguments);
    expect_wrong_call(splotchcl_in(folder, arguments));
    EXPECT_EQ(folder.count_files(), 0U);
  }
}

TEST(Arguments, FailWhenTheAnswerCannotBeWritten) {
  const TemporaryFolder folder;
  const ProgramResult result = splotchcl_in(folder, "generate --help > /dev/full");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_TRUE(is_one_line(result.err)) << result.err;
}

TEST(Devices, AreListedWithTheDefaultMarked) {
  SKIP_WITHOUT_DEVICE();
  const TemporaryFolder folder;
  const ProgramResult result = splotchcl_in(folder, "devices");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, StartsWith("* "));
}

TEST(Devices, AreMissedWithAdvice) {
  const TemporaryFolder folder;
  // The loader looks for drivers where this says: nowhere.
  const ProgramResult result =
      run_in(folder,
             "mkdir none; OCL_ICD_VENDORS=$PWD/none OPENCL_VENDOR_PATH=$PWD/none "
             "\"$splotchcl\" devices");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.out, "");
  EXPECT_TRUE(is_one_line(result.err)) << result.err;
  EXPECT_THAT(result.err, HasSubstr("pocl-opencl-icd"));
}

}  // namespace
}  // namespace splotchcl::test
