#include "system/system.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "testing.h"

namespace splotchcl::test {
namespace {

namespace fs = std::filesystem;

TEST(OfSystem, KnowsItsOwnProcess) {
  if (of_system::own_program().empty()) GTEST_SKIP() << "not started by its whole path";
  EXPECT_EQ(of_system::start_of_process(::getpid()), of_system::start_of_process(::getpid()));
  EXPECT_TRUE(fs::equivalent(of_system::own_program(), fs::read_symlink("/proc/self/exe")));
}

TEST(OfSystem, FindsTheFileThatHoldsAnAddress) {
  if (of_system::own_program().empty()) GTEST_SKIP() << "not started by its whole path";
  static const char here = 0;
  EXPECT_TRUE(fs::equivalent(of_system::file_around(&here), of_system::own_program()));
}

TEST(OfSystem, HasAsMuchMemoryAndCoresAsThereCanBe) {
  constexpr std::uint64_t most = std::uint64_t{1} << 60;
  EXPECT_LT(of_system::memory_left().value_or(0), most);
  EXPECT_LT(of_system::address_space_in_use().value_or(0), most);
  EXPECT_GE(of_system::allowed_cores().value_or(1), 1);
}

TEST(OfSystem, FillsWithOtherBytesEachTime) {
  std::array<unsigned char, 16> first = {}, second = {};
  ASSERT_TRUE(of_system::fill_with_chance(first.data(), first.size()));
  ASSERT_TRUE(of_system::fill_with_chance(second.data(), second.size()));
  EXPECT_NE(first, second);
}

TEST(OfSystem, ConnectsEndsThatChildrenDoNotInherit) {
  int ends[2] = {};
  ASSERT_TRUE(of_system::connect_ends(ends));
  EXPECT_EQ(of_system::send_without_signal(ends[0], "ab", 2, 0), 2);
  std::array<char, 2> received = {};
  EXPECT_EQ(::read(ends[1], received.data(), received.size()), 2);
  for (const int end : ends)
    EXPECT_EQ(::fcntl(end, F_GETFD) & FD_CLOEXEC, FD_CLOEXEC);
  ::close(ends[0]);
  ::close(ends[1]);
}

TEST(OfSystem, SendsNoSignalWhereTheOtherEndIsGone) {
  int ends[2] = {};
  ASSERT_TRUE(of_system::connect_ends(ends));
  ::close(ends[1]);
  EXPECT_EQ(of_system::send_without_signal(ends[0], "ab", 2, 0), -1);
  EXPECT_EQ(errno, EPIPE);
  ::sigset_t waiting = {};
  ::sigpending(&waiting);
  EXPECT_EQ(::sigismember(&waiting, SIGPIPE), 0);
  ::close(ends[0]);
}

TEST(OfSystem, OpensPipesThatChildrenDoNotInherit) {
  int ends[2] = {};
  ASSERT_TRUE(of_system::open_pipe(ends));
  EXPECT_EQ(::write(ends[1], "a", 1), 1);
  for (const int end : ends) {
    EXPECT_EQ(::fcntl(end, F_GETFD) & FD_CLOEXEC, FD_CLOEXEC);
    ::close(end);
  }
}

TEST(OfSystem, KnowsWhenAFileWasWritten) {
  if (of_system::own_program().empty()) GTEST_SKIP() << "not started by its whole path";
  struct stat file = {};
  ASSERT_EQ(::stat(of_system::own_program().c_str(), &file), 0);
  EXPECT_EQ(of_system::written_at(file).tv_sec, file.st_mtime);
}

}  // namespace
}  // namespace splotchcl::test
