// That breaches are found, in made-up projects.
#include "architecture/rules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "temporary_folder.h"

namespace splotchcl::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// A roof on walls on the ground.
class Rules : public ::testing::Test {
 protected:
  Rules() {
    write("include/splotchcl/ground.h", "");
    write("include/splotchcl/walls.h", "#include \"splotchcl/ground.h\"\n");
    write("src/ground/stone.h", "");
    write("src/walls/brick.h", "#include \"ground/stone.h\"\n");
    write("src/walls/paint/color.h", "");
    write("src/roof/roof.cpp", "#include <vector>\n#include \"splotchcl/walls.h\"\n");
  }

  void write(const std::string& path, const std::string& text) {
    std::filesystem::create_directories((folder_ / path).parent_path());
    std::ofstream(folder_ / path) << text;
  }
  const std::filesystem::path& root() const { return folder_.path(); }

  static TargetTable table() {
    std::istringstream text(
        "target ground\nfolder src/ground\nheader splotchcl/ground.h\n"
        "target walls\nfolder src/walls\nheader splotchcl/walls.h\nlinks ground\n"
        "target paint\nfolder src/walls/paint\n"
        "target roof\nfolder src/roof\nlinks walls\n");
    return TargetTable::read(text);
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(Rules, HoldForASoundProject) {
  EXPECT_THAT(find_wrong_includes(table(), root()), IsEmpty());
  EXPECT_THAT(find_idle_links(table(), root()), IsEmpty());
  EXPECT_THAT(find_stray_headers(table(), root()), IsEmpty());
  EXPECT_THAT(find_stray_files(table(), root()), IsEmpty());
  EXPECT_THAT(find_cycles(table()), IsEmpty());
}

TEST_F(Rules, FindAHeaderThatIncludesAHigherOne) {
  write("src/ground/stone.h", "  #  include \"walls/brick.h\"\n");
  EXPECT_THAT(
      find_wrong_includes(table(), root()),
      ElementsAre("src/ground/stone.h includes walls/brick.h, but ground does not link walls"));
}

TEST_F(Rules, FindAPublicHeaderThatIncludesAHigherOne) {
  write("include/splotchcl/ground.h", "#include \"splotchcl/walls.h\"\n");
  EXPECT_THAT(find_wrong_includes(table(), root()),
              ElementsAre("include/splotchcl/ground.h includes splotchcl/walls.h, but ground does "
                          "not link walls"));
}

TEST_F(Rules, FindASourceThatReachesThroughAPrivateLink) {
  write("src/roof/roof.cpp", "#include \"splotchcl/walls.h\"\n#include \"ground/stone.h\"\n");
  EXPECT_THAT(find_wrong_includes(table(), root()),
              ElementsAre("src/roof/roof.cpp includes ground/stone.h, but roof does not link "
                          "ground"));
}

TEST_F(Rules, LetASourceReachThroughAPublicLink) {
  write("src/roof/roof.cpp", "#include \"splotchcl/walls.h\"\n#include \"ground/stone.h\"\n");
  std::vector<Target> targets = table().targets();
  targets[1].exports = {"ground"};
  EXPECT_THAT(find_wrong_includes(TargetTable(targets), root()), IsEmpty());
}

TEST_F(Rules, TellInnerFoldersFromOuterOnes) {
  write("src/walls/brick.h", "#include \"ground/stone.h\"\n#include \"paint/color.h\"\n");
  EXPECT_THAT(
      find_wrong_includes(table(), root()),
      ElementsAre("src/walls/brick.h includes paint/color.h, but walls does not link paint"));
}

TEST_F(Rules, FindAnIncludeOfNobodysFile) {
  write("src/roof/roof.cpp", "#include \"splotchcl/walls.h\"\n#include \"sky/cloud.h\"\n");
  EXPECT_THAT(find_wrong_includes(table(), root()),
              ElementsAre("src/roof/roof.cpp includes sky/cloud.h, which is in no target"));
}

TEST_F(Rules, FindALinkThatNothingIncludes) {
  write("src/roof/roof.cpp", "");
  EXPECT_THAT(find_idle_links(table(), root()),
              ElementsAre("roof links walls, of which it includes nothing"));
}

TEST_F(Rules, FindHeadersWithoutOneOwner) {
  write("include/splotchcl/garden.h", "");
  std::vector<Target> targets = table().targets();
  targets[3].public_headers = {"splotchcl/walls.h", "splotchcl/chimney.h"};
  EXPECT_THAT(find_stray_headers(TargetTable(targets), root()),
              ElementsAre("splotchcl/chimney.h of roof does not exist",
                          "splotchcl/garden.h belongs to 0 targets",
                          "splotchcl/walls.h belongs to 2 targets"));
}

TEST_F(Rules, FindFilesOfNoTarget) {
  write("src/garden/tree.cpp", "");
  EXPECT_THAT(find_stray_files(table(), root()), ElementsAre("src/garden/tree.cpp"));
}

TEST_F(Rules, FindCycles) {
  std::vector<Target> targets = table().targets();
  targets[0].links = {"roof"};
  EXPECT_THAT(find_cycles(TargetTable(targets)), ElementsAre("ground -> roof -> walls -> ground"));
}

TEST_F(Rules, FindCyclesThroughWhatComesWithATarget) {
  std::vector<Target> targets = table().targets();
  targets[0].exports = {"ground"};
  EXPECT_THAT(find_cycles(TargetTable(targets)), ElementsAre("ground -> ground"));
}

TEST(TargetTable, RefusesOtherText) {
  std::istringstream headless("links ground\n"), unknown("target roof\nknows ground\n");
  EXPECT_THROW(TargetTable::read(headless), std::runtime_error);
  EXPECT_THROW(TargetTable::read(unknown), std::runtime_error);
}

}  // namespace
}  // namespace splotchcl::test
