// The project's own files and targets.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "architecture/rules.h"
#include "paths.h"

namespace splotchcl::test {
namespace {

using ::testing::Contains;
using ::testing::IsEmpty;
using ::testing::Not;

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
  EXPECT_THAT(find_stray_files(table(), test::source_folder()), IsEmpty());
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

}  // namespace
}  // namespace splotchcl::test
