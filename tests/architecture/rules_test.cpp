#include "architecture/rules.h"

#include "matches.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// That breaches are found, in made-up projects.

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

// The project's own files and targets.

const TargetTable& table() {
  static const TargetTable read = [] {
    std::ifstream file(SPLOTCHCL_TARGET_TABLE);
    return TargetTable::read(file);
  }();
  return read;
}

// A link of this target, or of one that it links, however far.
std::set<std::string> all_below(const std::string& name) {
  std::set<std::string> below;
  std::vector<std::string> open = {name};
  while (!open.empty()) {
    const Target* const target = table().find(open.back());
    open.pop_back();
    if (target == nullptr) continue;
    for (const std::vector<std::string>* const links : {&target->links, &target->exports}) {
      for (const std::string& link : *links) {
        if (below.insert(link).second) open.push_back(link);
      }
    }
  }
  return below;
}

TEST(Project, TableHasItsTargets) {
  for (const char* const name : {"splotchcl", "splotchcl_device", "splotchcl_scene"})
    EXPECT_NE(table().find(name), nullptr) << name;
}

TEST(Project, IncludesOnlyWhatItLinks) {
  EXPECT_THAT(find_wrong_includes(table(), test::source_folder()), IsEmpty());
}

TEST(Project, LinksOnlyWhatItIncludes) {
  EXPECT_THAT(find_idle_links(table(), test::source_folder()), IsEmpty());
}

TEST(Project, EachPublicHeaderBelongsToOneTarget) {
  EXPECT_THAT(find_stray_headers(table(), test::source_folder()), IsEmpty());
}

TEST(Project, EachFileBelongsToATarget) {
  std::vector<std::string> stray = find_stray_files(table(), test::source_folder());
  // Where OpenVDB is not installed, its module is no target.
  const auto module = std::find(stray.begin(), stray.end(), "src/openvdb/module.cpp");
  if (table().find("splotchcl_openvdb") == nullptr && module != stray.end()) stray.erase(module);
  EXPECT_THAT(stray, IsEmpty());
}

TEST(Project, HasNoCycles) {
  EXPECT_THAT(find_cycles(table()), IsEmpty());
}

TEST(Project, SceneIsBelowAll) {
  EXPECT_THAT(all_below("splotchcl_scene"), IsEmpty());
}

TEST(Project, DeviceAndReferenceDoNotKnowEachOther) {
  EXPECT_THAT(all_below("splotchcl_device"), Not(Contains("splotchcl_reference")));
  EXPECT_THAT(all_below("splotchcl_reference"), Not(Contains("splotchcl_device")));
}

// How branched the kernels are, as scripts/measure_shape counts it. Lower the numbers when they
// fall; what raises them has to be worth it.

// What each #if, #ifdef, #ifndef and #elif of the kernels asks for.
std::vector<std::string> conditions_of_kernels() {
  std::vector<std::string> conditions;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(source_folder() / "kernels")) {
    if (!entry.is_regular_file()) continue;
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line);) {
      for (const Match& match : matches_of(line, R"(^\s*#\s*(?:if|ifdef|ifndef|elif)\b(.*))"))
        conditions.push_back(match[1]);
    }
  }
  return conditions;
}

std::set<std::string> macros_of(const std::vector<std::string>& conditions) {
  std::set<std::string> macros;
  for (const std::string& condition : conditions) {
    for (const Match& match : matches_of(condition, R"(\b([A-Z_]\w+)\b)")) {
      const std::string name = match[1];
      if (name.rfind("__", 0) != 0 && name.rfind("SPLOTCHCL_", 0) != 0) macros.insert(name);
    }
  }
  return macros;
}

TEST(Shape, KernelsAreNoMoreBranchedThanTheyWere) {
  const std::vector<std::string> conditions = conditions_of_kernels();
  EXPECT_GT(conditions.size(), 100u);  // they were found
  EXPECT_LE(conditions.size(), 226u);
  EXPECT_LE(macros_of(conditions).size(), 32u);
}

}  // namespace
}  // namespace splotchcl::test
