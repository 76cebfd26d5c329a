// What becomes of a child process becomes an exception, and nothing else of it is seen.
#include "untrusted/child_process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <string>

#include "splotchcl/error.h"

namespace splotchcl {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// What is thrown, or nothing.
template <typename Exception>
std::string error_of(const std::function<void()>& task, const ChildLimits& limits = {}) {
  try {
    run_in_child("file", task, limits);
  } catch (const Exception& error) {
    return error.what();
  }
  return "";
}

TEST(ChildProcess, ReturnsWhereItsTaskReturnsAndChangesNothingHere) {
  int changed = 0;
  run_in_child("file", [&] { changed = 1; }, {});
  EXPECT_EQ(changed, 0);
}

TEST(ChildProcess, HandsOnErrors) {
  EXPECT_EQ(error_of<DataError>([] { throw DataError("file: damaged"); }), "file: damaged");
  EXPECT_EQ(error_of<UsageError>([] { throw UsageError("no such column"); }), "no such column");
}

TEST(ChildProcess, ThatCrashesIsAnError) {
  for (const int signal : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGKILL}) {
    EXPECT_THAT(error_of<DataError>([signal] { std::raise(signal); }),
                AllOf(StartsWith("file: "), HasSubstr("crashed")))
        << signal;
  }
  EXPECT_THAT(error_of<DataError>([] { ::_exit(0); }), HasSubstr("crashed"));
}

TEST(ChildProcess, ThatCrashesDoesNotCallTheHandlersOfThisOne) {
  const auto before = std::signal(SIGSEGV, [](int) { ::_exit(0); });
  EXPECT_THAT(error_of<DataError>([] { std::raise(SIGSEGV); }), HasSubstr("crashed"));
  std::signal(SIGSEGV, before);
}

TEST(ChildProcess, ThatDoesNotEndIsEnded) {
  ChildLimits limits;
  limits.seconds = 1;
  EXPECT_THAT(error_of<DataError>([] { ::pause(); }, limits), HasSubstr("did not end in 1 s"));
}

TEST(ChildProcess, ThatClaimsTooMuchMemoryIsRefusedIt) {
  ChildLimits limits;
  limits.memory_bytes = 64 << 20;
  const auto claim = [] {
    void* const memory = std::malloc(std::size_t{1} << 30);
    if (memory == nullptr) throw std::bad_alloc();
    std::free(memory);
  };
  EXPECT_THAT(error_of<DataError>(claim, limits), HasSubstr("more than 64 MiB"));
  EXPECT_EQ(error_of<DataError>(claim), "");
}

TEST(ChildProcess, IsAnErrorWithoutTime) {
  ChildLimits limits;
  limits.seconds = 0;
  EXPECT_THAT(error_of<UsageError>([] {}, limits), HasSubstr("expected at least 1"));
}

// Lines of libraries are not the caller's.
TEST(ChildProcess, IsNotHeard) {
  ::testing::internal::CaptureStderr();
  run_in_child("file", [] { std::fputs("a library's own line\n", stderr); }, {});
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace splotchcl
