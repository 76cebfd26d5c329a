#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/program.h"

namespace splotchcl::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(Generate, MakesTheSameFileFromTheSameSeed) {
  const TemporaryFolder folder;
  for (const std::string name : {"a", "b"}) {
    const ProgramResult result =
        splotchcl_in(folder, "generate halo -o " + name + " --particles 3000 --seed 5");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
  }
  EXPECT_EQ(read_text(folder / "a"), read_text(folder / "b"));
}

TEST(Generate, MakesWhatInfoDescribes) {
  const TemporaryFolder folder;
  const ProgramResult result = run_in(
      folder, "\"$splotchcl\" generate universe -o u --particles 3000 && \"$splotchcl\" info u");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("Gadget format 2"), HasSubstr("gas: 2550 particles"),
                                HasSubstr("stars: 450 particles"), HasSubstr("AGE")));
}

TEST(Generate, RefusesWhatItCannotMake) {
  const TemporaryFolder folder;
  const ProgramResult result = splotchcl_in(folder, "generate galaxy -o g");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_TRUE(is_one_line(result.err)) << result.err;
  EXPECT_THAT(result.err, AllOf(HasSubstr("galaxy"), HasSubstr("universe"), HasSubstr("halo")));
}

TEST(Generate, RefusesNumbersBelowZeroAsTheyWereWritten) {
  const TemporaryFolder folder;
  for (const char* option : {"--particles", "--seed"}) {
    const ProgramResult result =
        splotchcl_in(folder, std::string("generate universe -o z ") + option + " -1");
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
    EXPECT_THAT(result.err, AllOf(HasSubstr(option), HasSubstr("found -1")));
  }
}

TEST(Generate, LeavesNothingBehindWhenTheDiskIsFull) {
  const TemporaryFolder folder;
  // 20 blocks of 512 or 1024 bytes; 3000 particles take more than 100 kB.
  const ProgramResult result =
      run_in(folder, "ulimit -f 20; \"$splotchcl\" generate halo -o h --particles 3000");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_TRUE(is_one_line(result.err)) << result.err;
  EXPECT_EQ(folder.count_files(), 0U);
}

TEST(Generate, NoticesAMissingFolderAtOnce) {
  const TemporaryFolder folder;
  // So many would take minutes to make.
  const ProgramResult result =
      run_in(folder, "timeout 10 \"$splotchcl\" generate universe -o no/u --particles 100000000");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("no/u"));
}

}  // namespace
}  // namespace splotchcl::test
