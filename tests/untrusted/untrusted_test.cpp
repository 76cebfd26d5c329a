#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <new>

#include "damaged_hdf5.h"
#include "formats/hdf5/snapshot_hdf5_writer.h"
#include "formats/snapshot_writer.h"
#include "splotchcl/image_file.h"
#include "splotchcl/snapshot_file.h"
#include "splotchcl/untrusted_file.h"
#include "system/system.h"
#include "testing.h"
#include "untrusted/untrusted_file.h"

namespace splotchcl::test {
namespace {

// Files that may be anything are read in a child process: whatever they do to a library, what comes
// back is nothing or an error.

class UntrustedFile : public ::testing::Test {
 protected:
  void SetUp() override { write_hdf5(folder_ / "whole.hdf5", small_snapshot()); }
  TemporaryFolder folder_;
};

TEST_F(UntrustedFile, ThatIsWholePasses) {
  EXPECT_NO_THROW(check_untrusted_snapshot(folder_ / "whole.hdf5"));
  write_image(folder_ / "whole.png", Image(4, 3));
  EXPECT_NO_THROW(check_untrusted_image(folder_ / "whole.png"));
}

TEST_F(UntrustedFile, ThatIsNotThereIsAnError) {
  EXPECT_THROW(check_untrusted_snapshot(folder_ / "none.hdf5"), DataError);
  EXPECT_THROW(check_untrusted_image(folder_ / "none.png"), DataError);
}

TEST_F(UntrustedFile, HasColumnsAsOpenedFilesHave) {
  SnapshotOptions options;
  options.columns = {"x", "y", "z"};
  EXPECT_THROW(check_untrusted_snapshot(folder_ / "whole.hdf5", options), UsageError);
}

// Some of them make HDF5 crash.
TEST_F(UntrustedFile, ThatIsDamagedPassesOrIsAnErrorAndNothingElse) {
  DamagedHdf5 damaged(read_text(folder_ / "whole.hdf5"), 1);
  int errors = 0;
  for (int i = 0; i < 60; ++i) {
    std::ofstream(folder_ / "damaged.hdf5", std::ios::binary) << damaged.next();
    try {
      check_untrusted_snapshot(folder_ / "damaged.hdf5");
    } catch (const DataError&) {
      ++errors;
    }
  }
  EXPECT_GE(errors, 10);
}

TEST_F(UntrustedFile, ThatIsHalfAPictureIsAnError) {
  write_image(folder_ / "half.png", Image(50, 50));
  std::filesystem::resize_file(folder_ / "half.png",
                               std::filesystem::file_size(folder_ / "half.png") / 2);
  EXPECT_THROW(check_untrusted_image(folder_ / "half.png"), DataError);
}

// Files that become shorter after they were read do not end the process that looks at them.

class CutFile : public ::testing::Test {
 protected:
  void SetUp() override {
    TestSnapshot written;
    written.counts = {0, 20000, 0, 0, 0, 0};
    add_block(written, "POS", 2U, 3);
    write_gadget(file_, written, 2);
  }
  void cut() const { std::filesystem::resize_file(file_, 10000); }

  TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_ / "snap";
};

TEST_F(CutFile, ReadsAsZerosAndIsTold) {
  const LiveFiles live;
  const auto snapshot = open_snapshot(file_);
  const Column column = snapshot->read(1, "position");
  ASSERT_NE(column[column.size() - 1], 0);
  EXPECT_NO_THROW(live.require_whole());
  cut();
  EXPECT_EQ(column[column.size() - 1], 0);
  EXPECT_NE(column[1], 0);
  EXPECT_THROW(live.require_whole(), DataError);
}

TEST_F(CutFile, IsNoneOfThoseThatComeLater) {
  const LiveFiles before;
  const Column column = open_snapshot(file_)->read(1, "position");
  cut();
  EXPECT_EQ(column[column.size() - 1], 0);
  EXPECT_NO_THROW(LiveFiles().require_whole());
}

TEST_F(CutFile, IsAnErrorWhereItIsReadAnew) {
  const LiveFiles live;
  const auto snapshot = open_snapshot(file_);
  cut();
  EXPECT_THROW((void)snapshot->read(1, "position"), DataError);
}

// What becomes of a child process becomes an exception, and nothing else of it is seen.

// What is thrown, or nothing.
template <typename Exception>
std::string error_of(const std::function<void()>& task, const ChildLimits& limits = {}) {
  return refusal_by<Exception>([&] { run_in_child("file", task, limits); });
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
  if (!of_system::address_space_in_use()) GTEST_SKIP() << "the system does not tell what is in use";
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
}  // namespace splotchcl::test
