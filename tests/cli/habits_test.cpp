// Words that people type who know other programs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/program.h"
#include "splotchcl/image_file.h"

namespace splotchcl::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// Gas 850, stars 150.
class Habits : public ::testing::Test {
 protected:
  Habits() { splotchcl_in(folder_, "generate universe -o u --particles 1000"); }

  // The scene that would be drawn.
  ProgramResult explain(const std::string& arguments) const {
    return splotchcl_in(folder_, "render u --explain " + arguments);
  }
  const TemporaryFolder folder_;
};

TEST_F(Habits, ASizeIsGivenInOneWord) {
  ASSERT_EQ(splotchcl_in(folder_, "render u -o picture.png --reference --size 32x24").exit_code, 0);
  const Image picture = read_image(folder_ / "picture.png");
  EXPECT_EQ(picture.width, 32);
  EXPECT_EQ(picture.height, 24);
}

TEST_F(Habits, ASizeOfOtherWordsIsRefusedInOneLine) {
  for (const char* size : {"32", "32x", "x24", "0x24", "32x24x3", "3.5x4", "99999x1", "-1x4"}) {
    const ProgramResult result =
        splotchcl_in(folder_, std::string("render u -o p.png --size=") + size);
    EXPECT_EQ(result.exit_code, 2) << size;
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
    EXPECT_THAT(result.err, HasSubstr("WIDTHxHEIGHT")) << size;
  }
}

TEST_F(Habits, TypesHaveTheNamesThatOthersGiveThem) {
  for (const char* type : {"star", "stars", "Stars", "PartType4", "4"}) {
    const ProgramResult result = explain(std::string("--set component.gas.types=") + type);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("not drawn: gas 850")) << type;
  }
}

TEST_F(Habits, AnotherTypeDropsWhatWasSuggestedForTheFirst) {
  // Stars have no temperature, by which gas is coloured.
  const ProgramResult result = explain("--set component.gas.types=stars");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, Not(HasSubstr("internal_energy")));
  EXPECT_THAT(result.err, HasSubstr("not drawn: gas 850"));
}

TEST_F(Habits, ASettingOfItsOwnIsKeptBesideAnotherType) {
  const ProgramResult result =
      explain("--set component.gas.types=stars --set component.gas.palette=magma");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("palette = \"magma\""));
}

TEST_F(Habits, AllThatIsDrawnIsNotSpokenOf) {
  EXPECT_THAT(explain("").err, Not(HasSubstr("not drawn")));
}

TEST_F(Habits, LogarithmsAreToTheBaseOfTen) {
  const std::string density =
      "--set component.gas.color.field=density --set component.gas.color.scaling=";
  const ProgramResult log10 = explain(density + "log10");
  EXPECT_EQ(log10.exit_code, 0) << log10.err;
  EXPECT_THAT(log10.out, HasSubstr("scaling = \"log\""));
}

}  // namespace
}  // namespace splotchcl::test
