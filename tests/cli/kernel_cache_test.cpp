// Kernels kept from run to run: what is damaged, or may come from others, is compiled again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "cli/program.h"

namespace splotchcl::testing {
namespace {

using ::testing::HasSubstr;

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

}  // namespace
}  // namespace splotchcl::testing
