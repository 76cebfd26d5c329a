// How much memory a picture may take.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/program.h"

namespace splotchcl::test {
namespace {

using ::testing::HasSubstr;

// A window has the splats of a chunk at least: this takes several.
constexpr const char* ordered_picture =
    "render u --set image.size=[120,90] --set component.gas.gray_absorption=0.3 ";

class Memory : public ::testing::Test {
 protected:
  void SetUp() override { SKIP_WITHOUT_DEVICE(); }
  ProgramResult draw(const std::string& arguments) const {
    return splotchcl_in(folder_, ordered_picture + arguments);
  }
  TemporaryFolder folder_;
};

TEST_F(Memory, DrawsTheSamePictureInLittleOfIt) {
  ASSERT_EQ(splotchcl_in(folder_, "generate universe -o u --particles 1300000").exit_code, 0);
  ASSERT_EQ(draw("-o whole.exr --stats whole.json").exit_code, 0);
  const ProgramResult result = draw("--explain --memory 1MB -o parts.exr --stats parts.json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("windows of depth, since there is room for 1 MB (--memory)"));
  EXPECT_EQ(read_text(folder_ / "whole.exr"), read_text(folder_ / "parts.exr"));
  const auto whole = nlohmann::json::parse(read_text(folder_ / "whole.json"));
  const auto parts = nlohmann::json::parse(read_text(folder_ / "parts.json"));
  EXPECT_EQ(whole["windows"], 0);
  EXPECT_GE(parts["windows"], 2);
  EXPECT_EQ(whole["particles"], parts["particles"]);
}

TEST_F(Memory, IsASizeWithAUnit) {
  for (const std::string size : {"much", "-1", "5XB", "0", "0GB"}) {
    const ProgramResult result = draw("-o a.png --memory " + size);
    EXPECT_EQ(result.exit_code, 2) << size;
    EXPECT_THAT(result.err, HasSubstr("--memory: found " + size + ", expected a size such as"));
  }
}

}  // namespace
}  // namespace splotchcl::test
