// Renders and films while a call of the system fails, or memory runs out: one line says so, and
// what is written is whole or not there.
#include "cli/program.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

class Faults : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(splotchcl_in(folder_, "generate halo -o h --particles 1000").exit_code, 0);
    std::ofstream(folder_ / "film.toml") << "snapshot = 'h'\n[image]\nsize = [16, 12]\n"
                                            "[path.orbit]\ndegrees = 90\n[movie]\nframes = 2\n"
                                            "[[component]]\npalette = 'white'\n";
    std::filesystem::create_directory(folder_ / "out");
  }

  std::set<std::string> names() const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "out"))
      names.insert(entry.path().filename().string());
    return names;
  }
  // Runs the program with an environment or limits before it; false: nothing failed.
  bool run_with(const std::string& trouble, const std::string& arguments,
                const std::set<std::string>& allowed) const {
    std::filesystem::remove_all(folder_ / "out");
    std::filesystem::create_directory(folder_ / "out");
    const ProgramResult result = run_in(folder_, trouble + " \"$splotchcl\" " + arguments);
    if (result.exit_code == 0) {
      EXPECT_EQ(result.err, "") << trouble;
      return false;
    }
    EXPECT_EQ(result.exit_code, 1) << trouble << "\n" << result.err;
    EXPECT_TRUE(is_one_line(result.err)) << trouble << "\n" << result.err;
    for (const std::string& name : names())
      EXPECT_EQ(allowed.count(name), 1U) << trouble << " left " << name;
    return true;
  }
  static std::string failing(const std::string& call, long which) {
    return "LD_PRELOAD=" SPLOTCHCL_FAILING_CALLS " SPLOTCHCL_FAULT=" + call + ":" +
           std::to_string(which);
  }
  // Each call in turn, until one more than there are. Says how many there are.
  int fail_each(const std::string& call, const std::string& arguments,
                const std::set<std::string>& allowed) const {
    constexpr int most = 200;
    int which = 1;
    while (which < most && run_with(failing(call, which), arguments, allowed))
      ++which;
    EXPECT_LT(which, most);
    return which - 1;
  }

  // Not each: there are many. Says how many of those that failed were noticed.
  int fail_some_allocations(const std::string& arguments,
                            const std::set<std::string>& allowed) const {
    int failures = 0;
    for (long which = 1; which < 1000000; which += 1 + which / (test::long_tests() ? 20 : 3))
      if (run_with(failing("malloc", which), arguments, allowed)) ++failures;
    return failures;
  }

  TemporaryFolder folder_;
  const std::string picture_ =
      "render h -o out/a.png --stats out/a.json --reference --set 'image.size=[16,12]'";
  const std::string images_ = "movie film.toml -o out/f_%d.png --reference";
  const std::string film_ = "movie film.toml -o out/f.mp4 --reference";
};

TEST_F(Faults, OfWritesLeaveNothingHalfWritten) {
  const std::set<std::string> whole = {"a.png"};  // the picture comes before its statistics
  EXPECT_GE(fail_each("write", picture_, whole), 2);
  EXPECT_GE(fail_each("fsync", picture_, whole), 2);
  EXPECT_GE(fail_each("rename", picture_, whole), 2);
}

TEST_F(Faults, OfWritesLeaveWholeFramesOfAFilm) {
  const std::set<std::string> frames = {"f_0.png", "f_1.png", "f_%d.png.movie.txt"};
  EXPECT_GE(fail_each("write", images_, frames), 3);
  EXPECT_GE(fail_each("rename", images_, frames), 2);
  if (run_in(folder_, "command -v ffmpeg").exit_code != 0) GTEST_SKIP() << "no ffmpeg";
  const std::set<std::string> unfinished = {"f.mp4.frames"};
  EXPECT_GE(fail_each("write", film_, unfinished), 3);
  EXPECT_GE(fail_each("rename", film_, unfinished), 3);
}

TEST_F(Faults, OfMemoryAreOneLine) {
  EXPECT_GE(fail_some_allocations(picture_, {"a.png"}), 5);
}

TEST_F(Faults, OfMemoryLeaveWholeFramesOfAFilm) {
  EXPECT_GE(fail_some_allocations(images_, {"f_0.png", "f_1.png", "f_%d.png.movie.txt"}), 5);
}

TEST_F(Faults, OfTheLimitOnMemoryAreOneLine) {
  int failures = 0;
  for (const int megabytes : {60, 120, 200, 300}) {
    const std::string limit = "ulimit -v " + std::to_string(1024 * megabytes) + ";";
    // Splats alone: clouds around the camera take the reference minutes in so large a picture. On a
    // slow machine it would tell how far it is.
    if (run_with(limit,
                 "render h --quiet -o out/a.png --reference --max-particles 300 "
                 "--set 'image.size=[2000,2000]' "
                 "--set camera.through_clouds=false",
                 {})) {
      ++failures;
    }
  }
  EXPECT_GE(failures, 1);
}

// An OpenCL implementation may abort the program where its own memory runs out, and its compiler
// takes the guard's place then: but it leaves nothing behind.
TEST_F(Faults, OfTheLimitOnMemoryOfADeviceLeaveNothing) {
  SKIP_WITHOUT_DEVICE();
  int failures = 0;
  for (const int megabytes : {150, 300, 450, 600}) {
    const ProgramResult result =
        run_in(folder_, "ulimit -v " + std::to_string(1024 * megabytes) +
                            "; \"$splotchcl\" render h -o out/a.png --set image.size=[1500,1500]");
    if (result.exit_code == 0) continue;
    ++failures;
    EXPECT_TRUE(names().empty()) << megabytes;
    EXPECT_TRUE(result.exit_code != 1 || is_one_line(result.err)) << result.err;
  }
  EXPECT_GE(failures, 1);
}

// What no compiler takes, as PoCL is told it.
TEST_F(Faults, OfTheCompilerOfKernelsAreOneLineThatSaysWhatToDo) {
  SKIP_WITHOUT_DEVICE();
  const ProgramResult result =
      run_in(folder_,
             "SPLOTCHCL_CACHE= POCL_EXTRA_BUILD_FLAGS=-fnonsense \"$splotchcl\" render h "
             "-o out/a.png --set image.size=[16,12]");
  if (result.exit_code == 0) GTEST_SKIP() << "this is not PoCL";
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_TRUE(is_one_line(result.err)) << result.err;
  EXPECT_THAT(result.err, HasSubstr("cannot compile"));
  EXPECT_THAT(result.err, HasSubstr("choose another device"));
  EXPECT_TRUE(names().empty());
}

}  // namespace
}  // namespace splotchcl::test
