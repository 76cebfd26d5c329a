// Kernels kept from run to run: what is damaged, or may come from others, is compiled again. Of
// those that are missing other processes compile some.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "cli/program.h"

namespace splotchcl::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class KernelCache : public ::testing::Test {
 protected:
  void SetUp() override {
    SKIP_WITHOUT_DEVICE();
    ASSERT_EQ(splotchcl_in(folder_, "generate halo -o h --particles 1000").exit_code, 0);
  }
  ProgramResult draw(const std::string& picture, const std::string& environment = "") const {
    return run_in(folder_, environment +
                               " SPLOTCHCL_CACHE=\"$PWD/kernels\" \"$splotchcl\" render h "
                               "--set 'image.size=[32,24]' -o " +
                               picture);
  }
  // PoCL keeps kernels, too: here it has none yet.
  ProgramResult draw_without_pocls_own(const std::string& picture) const {
    const std::string own = "pocl_of_" + picture;
    std::filesystem::create_directory(folder_ / own);
    return draw(picture, "POCL_CACHE_DIR=\"$PWD/" + own + "\"");
  }
  std::vector<std::filesystem::path> files() const {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "kernels"))
      files.push_back(entry.path());
    return files;
  }
  TemporaryFolder folder_;
};

TEST_F(KernelCache, OfAMapIsFilledWithoutALineOfCompilers) {
  const ProgramResult result =
      run_in(folder_,
             "mkdir pocl && POCL_CACHE_DIR=\"$PWD/pocl\" SPLOTCHCL_CACHE=\"$PWD/kernels\" "
             "\"$splotchcl\" map h --quantity counts --size 32x24 -o map.fits");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, Not(HasSubstr("warning")));
}

// In the second half, where the code of most is.
TEST_F(KernelCache, ThatIsDamagedIsCompiledAgain) {
  ASSERT_EQ(draw_without_pocls_own("first.png").exit_code, 0);
  std::mt19937 random(1);
  ASSERT_FALSE(files().empty());
  for (const auto& path : files()) {
    std::string bytes = read_text(path);
    for (std::size_t i = bytes.size() / 2; i < bytes.size(); i += 1 + random() % 50)
      bytes[i] = static_cast<char>(bytes[i] ^ 0x10);
    std::ofstream(path, std::ios::binary) << bytes;
  }
  const ProgramResult result = draw_without_pocls_own("second.png");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(read_text(folder_ / "second.png"), read_text(folder_ / "first.png"));
}

TEST_F(KernelCache, ThatOthersMayWriteToIsNotUsed) {
  std::filesystem::create_directory(folder_ / "kernels");
  std::filesystem::permissions(folder_ / "kernels", std::filesystem::perms::all);
  EXPECT_THAT(draw("a.png").err, HasSubstr("may be written to by others"));
}

// Draws in the background, and does `with_child` as soon as $parent has started a $child. Exit code
// 98: it has started none.
std::string while_compiling(const std::string& with_child) {
  return "mkdir pocl && export POCL_CACHE_DIR=\"$PWD/pocl\" SPLOTCHCL_CACHE=\"$PWD/kernels\"\n"
         "\"$splotchcl\" render h --set 'image.size=[32,24]' -o a.png & parent=$!\n"
         "child=; while [ -z \"$child\" ]; do\n"
         "  kill -0 $parent 2>/dev/null || exit 98\n"
         "  child=$(cat /proc/$parent/task/*/children 2>/dev/null | tr -d ' ')\n"
         "  sleep 0.01\n"
         "done\n" +
         with_child;
}

class KernelCompilers : public KernelCache {
 protected:
  void SetUp() override {
    KernelCache::SetUp();
    if (std::thread::hardware_concurrency() < 2) GTEST_SKIP() << "only on several cores";
  }
};

TEST_F(KernelCompilers, ThatAreKilledAreDoneWithout) {
  const ProgramResult result =
      run_in(folder_, while_compiling("kill -KILL $child; wait $parent || exit 97"));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, Not(HasSubstr("compil")));
  ASSERT_EQ(draw("b.png").exit_code, 0);
  EXPECT_EQ(read_text(folder_ / "a.png"), read_text(folder_ / "b.png"));
}

// Ended, or a zombie that nobody has to wait for any more.
TEST_F(KernelCompilers, DoNotOutliveTheProcessThatStartedThem) {
  const ProgramResult result =
      run_in(folder_, while_compiling("kill -KILL $parent; for i in $(seq 500); do\n"
                                      "  state=$(sed 's/.*) //' /proc/$child/stat 2>/dev/null)\n"
                                      "  case \"$state\" in ''|Z*) exit 0;; esac; sleep 0.02\n"
                                      "done; exit 96"));
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST_F(KernelCompilers, DoNotNeedAFolderThatCanBeWrittenTo) {
  std::ofstream(folder_ / "file") << "no folder";
  const std::string command =
      "mkdir pocl && POCL_CACHE_DIR=\"$PWD/pocl\" SPLOTCHCL_CACHE=\"$PWD/file/kernels\" "
      "\"$splotchcl\" render h --set 'image.size=[32,24]' -o a.png";
  const ProgramResult result = run_in(folder_, command);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  ASSERT_EQ(draw("b.png").exit_code, 0);
  EXPECT_EQ(read_text(folder_ / "a.png"), read_text(folder_ / "b.png"));
}

TEST_F(KernelCompilers, SayWhatTheyAreForWhenAUserStartsOne) {
  const ProgramResult result = splotchcl_in(folder_, "compile-for-another");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_TRUE(is_one_line(result.err)) << result.err;
  EXPECT_THAT(result.err, HasSubstr("expected to be started by another splotchcl"));
}

}  // namespace
}  // namespace splotchcl::test
