#include <csignal>
#include <cstdio>

#include "common/guards.h"
#include "common/unfinished_file.h"
#include "testing.h"

namespace splotchcl {
namespace {

using ::testing::ExitedWithCode;

TEST(CrashGuard, EndsAnAbortedProgramWithALine) {
  EXPECT_EXIT(
      {
        guard_crashes();
        std::abort();
      },
      ExitedWithCode(1), "^splotchcl: a library failed.*\n$");
}

TEST(CrashGuard, NeedsNoSignalWhereAnExceptionGoesTooFar) {
  EXPECT_EXIT(
      {
        guard_crashes();
        std::signal(SIGABRT, SIG_DFL);  // as OpenCL's compiler does it for a time
        std::terminate();
      },
      ExitedWithCode(1), "^splotchcl: a library failed.*\n$");
}

TEST(CrashGuard, TakesUnfinishedFilesAway) {
  const test::TemporaryFolder folder;
  EXPECT_EXIT(
      {
        guard_crashes();
        UnfinishedFile file(folder / "picture");
        file.write("half", 4);
        std::raise(SIGSEGV);
      },
      ExitedWithCode(1), "a library failed");
  EXPECT_EQ(folder.count_files(), 0U);
}

TEST(CrashGuard, SpeaksWhereLibrariesAreQuiet) {
  EXPECT_EXIT(
      {
        guard_crashes();
        let_errors_be_quiet();
        const QuietErrors quiet;
        std::fputs("a library's own line\n", stderr);
        std::abort();
      },
      ExitedWithCode(1), "^splotchcl: a library failed");
}

TEST(QuietErrors, AreHeardAgainAfterwards) {
  EXPECT_EXIT(
      {
        let_errors_be_quiet();
        {
          const QuietErrors quiet;
          const QuietErrors more;
          std::fputs("not heard\n", stderr);
        }
        std::fputs("heard\n", stderr);
        std::exit(0);
      },
      ExitedWithCode(0), "^heard\n$");
}

TEST(QuietErrors, LeaveTheProgramItsVoice) {
  EXPECT_EXIT(
      {
        let_errors_be_quiet();
        const QuietErrors quiet;
        std::fputs("a library's own line\n", stderr);
        std::fputs("the program's\n", error_stream());
        std::exit(0);
      },
      ExitedWithCode(0), "^the program's\n$");
}

}  // namespace
}  // namespace splotchcl
