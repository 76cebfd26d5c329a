// Trees of merged particles, from the command that makes them to what is told of a picture.
#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

class Trees : public ::testing::Test {
 protected:
  void SetUp() override {
    SKIP_WITHOUT_DEVICE();
    copy_into(folder_, folder_after("\"$splotchcl\" generate universe --particles 100000 -o u && "
                                    "\"$splotchcl\" tree u"));
  }
  ProgramResult render(const std::string& arguments) const {
    return splotchcl_in(folder_,
                        "render u --set kernel.footprint=0.5 --size 24x16 "
                        "--tolerance 0.02 -o u.png " +
                            arguments);
  }
  nlohmann::json stats() const {
    return nlohmann::json::parse(read_text(folder_ / "stats.json")).at("tree");
  }

  TemporaryFolder folder_;
};

TEST_F(Trees, TellNodesBytesTheEstimateAndWhatWasFound) {
  const ProgramResult drawn = render("--tree only --stats stats.json");
  ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
  const nlohmann::json tree = stats();
  ASSERT_FALSE(tree.is_null()) << drawn.err;
  EXPECT_GT(tree.at("nodes"), 100);
  EXPECT_LT(tree.at("nodes").get<int>() + tree.at("particles").get<int>(), 75000);
  EXPECT_GT(tree.at("bytes"), 20 * tree.at("visited").get<int>());
  EXPECT_GT(tree.at("estimate_of_promise"), 0.05);
  EXPECT_GT(tree.at("found_of_promise"), 0);
  EXPECT_LE(tree.at("found_of_promise"), 1);
}

TEST_F(Trees, AreExplainedWhereTheyAreUsed) {
  EXPECT_THAT(render("--tree only --explain").out,
              AllOf(HasSubstr("# tree: "), HasSubstr(" nodes and ")));
  EXPECT_THAT(render("--tree never --explain").out, Not(HasSubstr("# tree: ")));
  EXPECT_THAT(render("--tree only --explain --certify").out, Not(HasSubstr("# tree: ")));
}

TEST_F(Trees, AreNotUsedWhereTheSceneSaysNever) {
  ASSERT_EQ(render("--tree never --stats stats.json").exit_code, 0);
  EXPECT_TRUE(stats().is_null());
}

}  // namespace
}  // namespace splotchcl::test
