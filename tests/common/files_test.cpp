// Files: how they are written, and changes while they are used.
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>

#include "common/file_identity.h"
#include "common/mapped_file.h"
#include "common/output_files.h"
#include "common/unfinished_file.h"
#include "system/system.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

namespace fs = std::filesystem;
using Files = std::set<std::filesystem::path>;

class OutputFiles : public ::testing::Test {
 protected:
  OutputFiles() { std::ofstream(folder_ / "data") << "mine"; }
  void check(const std::string& name, const Files& inputs) const {
    check_outputs({{folder_ / name, "-o"}}, [&] { return inputs; });
  }
  test::TemporaryFolder folder_;
};

TEST_F(OutputFiles, AreNoInputs) {
  EXPECT_THROW(check("data", {folder_ / "data"}), UsageError);
  EXPECT_NO_THROW(check("other", {folder_ / "data"}));
}

TEST_F(OutputFiles, AreNoInputsByOtherNames) {
  std::filesystem::create_symlink("data", folder_ / "soft");
  std::filesystem::create_hard_link(folder_ / "data", folder_ / "hard");
  EXPECT_THROW(check("soft", {folder_ / "data"}), UsageError);
  EXPECT_THROW(check("hard", {folder_ / "soft"}), UsageError);
  EXPECT_THROW(check("data", {folder_ / "." / "data"}), UsageError);
}

TEST_F(OutputFiles, MayBeMissingInputs) {
  EXPECT_NO_THROW(check("missing", {folder_ / "missing"}));
}

TEST_F(OutputFiles, AreDifferentFiles) {
  const auto check_two = [this](const std::string& a, const std::string& b) {
    check_outputs({{folder_ / a, "-o"}, {folder_ / b, "--stats"}}, [] { return Files(); });
  };
  EXPECT_THROW(check_two("new", "./new"), UsageError);
  EXPECT_THROW(check_two("data", "data"), UsageError);
  EXPECT_NO_THROW(check_two("data", "new"));
}

TEST_F(OutputFiles, DoNotAskForInputsWhereNoneExists) {
  EXPECT_NO_THROW(check_outputs({{folder_ / "new", "-o"}}, []() -> Files { throw 1; }));
}

TEST_F(OutputFiles, OfAFolderOfTheProgramsOwnDoNotHoldInputs) {
  std::filesystem::create_directories(folder_ / "own" / "below");
  std::ofstream(folder_ / "own" / "below" / "input") << "mine";
  const auto check_folder = [this](const Files& inputs) {
    check_own_folder(folder_ / "own", "-o", [&] { return inputs; });
  };
  EXPECT_THROW(check_folder({folder_ / "own" / "below" / "input"}), UsageError);
  EXPECT_NO_THROW(check_folder({folder_ / "data"}));
}

// No system has a process of this number.
constexpr const char* no_process = "999999999";

class UnfinishedFiles : public ::testing::Test {
 protected:
  // The unfinished file of `target` that this process would write, but of another one.
  fs::path left(const std::string& target, const std::string& process, const std::string& start,
                const std::string& machine) const {
    const std::string own = UnfinishedFile(folder_ / target).temporary_path().filename().string();
    const std::string name = own.substr(0, own.rfind('.', own.rfind('@')));
    return add(name + "." + process + "@" + start + "@" + machine + "-7.part");
  }
  fs::path add(const std::string& name) const {
    std::ofstream(folder_ / name) << "half";
    return folder_ / name;
  }
  bool stays(const fs::path& file, const std::string& target = "a.png") const {
    check_output_path(folder_ / target);
    return fs::exists(file);
  }
  static void write_days_ago(const fs::path& file, int days) {
    fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(24) * days);
  }
  std::string own_number() const { return std::to_string(own_.number); }
  std::string own_start() const { return std::to_string(own_.start); }

  const WritingProcess own_ = WritingProcess::own();
  test::TemporaryFolder folder_;
};

TEST_F(UnfinishedFiles, OfProcessesThatHaveEndedAreRemovedByTheNextOne) {
  EXPECT_FALSE(stays(left("a.png", no_process, "1", own_.machine)));
}

// Nobody has asked how it ended, as nobody does in many containers.
TEST_F(UnfinishedFiles, OfProcessesOfWhichOnlyTheNumberIsLeftAreRemoved) {
  if (own_.start == 0) GTEST_SKIP() << "the system does not tell how a process is";
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) ::pause();
  const std::string number = std::to_string(child);
  const std::string start = std::to_string(of_system::start_of_process(child));
  const fs::path file = left("a.png", number.c_str(), start, own_.machine);
  EXPECT_TRUE(stays(file));
  ::kill(child, SIGKILL);
  siginfo_t ended = {};
  ASSERT_EQ(::waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOWAIT), 0);
  EXPECT_FALSE(stays(file));
  ::waitpid(child, nullptr, 0);
}

TEST_F(UnfinishedFiles, OfEarlierVersionsAreRemovedToo) {
  EXPECT_FALSE(stays(add(std::string(".a.png.") + no_process + "-1.part")));
  EXPECT_TRUE(stays(add(".a.png." + own_number() + "-1.part")));
}

TEST_F(UnfinishedFiles, OfOtherTargetsStay) {
  EXPECT_TRUE(stays(left("b.png", no_process, "1", own_.machine)));
}

TEST_F(UnfinishedFiles, OfProcessesThatRunStay) {
  EXPECT_TRUE(stays(left("a.png", own_number(), own_start(), own_.machine)));
  const UnfinishedFile file(folder_ / "a.png");
  EXPECT_TRUE(stays(file.temporary_path()));
}

TEST_F(UnfinishedFiles, OfAnEarlierProcessWithTheNumberOfOneThatRunsAreRemoved) {
  if (own_.start == 0) GTEST_SKIP() << "the system does not tell when a process began";
  EXPECT_FALSE(stays(left("a.png", own_number(), "1", own_.machine)));
}

TEST_F(UnfinishedFiles, OfProcessesWhoseStartIsUnknownStay) {
  EXPECT_TRUE(stays(left("a.png", own_number(), "0", own_.machine)));
}

TEST_F(UnfinishedFiles, OfOtherMachinesStayForAWeek) {
  const fs::path file = left("a.png", no_process, "1", "other~01234567");
  EXPECT_TRUE(stays(file));
  write_days_ago(file, 6);
  EXPECT_TRUE(stays(file));
  write_days_ago(file, -6);
  EXPECT_TRUE(stays(file));
  write_days_ago(file, 8);
  EXPECT_FALSE(stays(file));
}

TEST_F(UnfinishedFiles, AreOnlyThoseWithNamesOfTheirForm) {
  for (const std::string name :
       {".a.png.part", ".a.png.-1.part", ".a.png.7x-1.part", ".a.png.7@-1.part",
        ".a.png.7@1-1.part", ".a.png.7@1@-1.part", ".a.png.-7@1@other-1.part",
        ".a.png.7@x@other-1.part", "-.part", "a.png.999999999-1.part"}) {
    const fs::path file = add(name);
    write_days_ago(file, 30);
    EXPECT_TRUE(stays(file)) << name;
  }
}

TEST_F(UnfinishedFiles, MayBeOfTheLongestNames) {
  const std::string ascii(255, 'x');
  std::string umlauts = "x";
  for (int i = 0; i < 127; ++i)
    umlauts += "\u00fc";
  for (const std::string& name : {ascii, umlauts}) {
    const fs::path of_killed = left(name, no_process, "1", own_.machine);
    EXPECT_FALSE(stays(of_killed, name));
    UnfinishedFile file(folder_ / name);
    file.write("whole", 5);
    file.finish();
    EXPECT_EQ(fs::file_size(folder_ / name), 5U);
  }
  const fs::path of_another = left(ascii, no_process, "1", own_.machine);
  EXPECT_TRUE(stays(of_another, ascii.substr(1) + "y"));
}

TEST_F(UnfinishedFiles, AreWrittenWhereLinksLeadAlsoWhereNothingIsThereYet) {
  fs::create_directory(folder_ / "below");
  fs::create_symlink("below/second", folder_ / "first");
  fs::create_symlink("../third", folder_ / "below" / "second");
  UnfinishedFile file(folder_ / "first");
  file.write("whole", 5);
  file.finish();
  EXPECT_EQ(fs::file_size(folder_ / "third"), 5U);
  EXPECT_TRUE(fs::is_symlink(folder_ / "first") && fs::is_symlink(folder_ / "below" / "second"));
}

TEST_F(UnfinishedFiles, AreRefusedWhereLinksLeadNowhere) {
  fs::create_symlink("none/file", folder_ / "to_no_folder");
  fs::create_symlink("circle", folder_ / "circle");
  EXPECT_THROW(UnfinishedFile(folder_ / "to_no_folder"), DataError);
  EXPECT_THROW(UnfinishedFile(folder_ / "circle"), DataError);
  EXPECT_TRUE(fs::is_symlink(folder_ / "to_no_folder"));
}

TEST_F(UnfinishedFiles, MayLeaveWhatHasComeUnderTheirNames) {
  UnfinishedFile late(folder_ / "name");
  late.write("mine", 4);
  {
    UnfinishedFile first(folder_ / "name");
    first.write("other", 5);
    EXPECT_TRUE(first.finish_unless_there());
  }
  EXPECT_FALSE(late.finish_unless_there());
  EXPECT_EQ(fs::file_size(folder_ / "name"), 5U);
}

// The name of a program stands before what is read of it.
TEST(WritingProcess, IsKnownWhateverItsProgramIsCalled) {
  const WritingProcess usual = WritingProcess::own();
  std::string name(16, '\0');
  ASSERT_EQ(::prctl(PR_GET_NAME, name.data()), 0);
  ASSERT_EQ(::prctl(PR_SET_NAME, ") S 1 (2) 3"), 0);
  const WritingProcess odd = WritingProcess::own();
  EXPECT_EQ(odd.start, usual.start);
  EXPECT_TRUE(odd.is_running());
  ::prctl(PR_SET_NAME, name.data());
}

TEST(MappedFile, RefusesAMissingFileByName) {
  try {
    MappedFile::open("no/such/file");
    FAIL() << "a missing file was opened";
  } catch (const DataError& error) {
    EXPECT_NE(std::string(error.what()).find("no/such/file"), std::string::npos);
  }
}

TEST(MappedFile, RefusesAFolder) {
  EXPECT_THROW(MappedFile::open("."), DataError);
}

class WatchedFile : public ::testing::Test {
 protected:
  void SetUp() override {
    write("a");
    watched_.add(path_);
  }
  void write(const char* text) const { std::ofstream(path_, std::ios::app) << text; }
  void replace() const {
    std::ofstream(folder_ / "other") << "another file";
    std::filesystem::rename(folder_ / "other", path_);
  }

  TemporaryFolder folder_;
  std::filesystem::path path_ = folder_ / "file";
  WatchedFiles watched_;
};

TEST_F(WatchedFile, ThatStaysIsNoError) {
  EXPECT_NO_THROW(watched_.check());
  EXPECT_NO_THROW(watched_.check_in_place());
  EXPECT_EQ(watched_.unchanged_during([] { return 7; }), 7);
}

TEST_F(WatchedFile, ThatIsWrittenToIsAnError) {
  write("b");
  EXPECT_THROW(watched_.check(), DataError);
  EXPECT_THROW(watched_.check_in_place(), DataError);
}

TEST_F(WatchedFile, WhoseNameIsTakenByAnotherStaysWhatItIsForWhoHasItOpen) {
  replace();
  EXPECT_THROW(watched_.check(), DataError);
  EXPECT_NO_THROW(watched_.check_in_place());
}

TEST_F(WatchedFile, ThatIsWrittenToWhileItIsUsedIsToldOfInPlaceOfWhatFollows) {
  const auto fail = [] { throw DeviceError("counted other particles than before"); };
  EXPECT_THROW(watched_.unchanged_during(fail), DeviceError);
  const auto write_and_fail = [&] {
    write("b");
    fail();
  };
  EXPECT_THAT([&] { watched_.unchanged_during(write_and_fail); },
              ThrowsMessage<DataError>(HasSubstr("changed while it was used")));
}

}  // namespace
}  // namespace splotchcl::test
