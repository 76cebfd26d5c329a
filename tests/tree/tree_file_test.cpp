#include "tree/tree_file.h"

#include <chrono>

#include "formats/snapshot_writer.h"
#include "splotchcl/snapshot_file.h"
#include "testing.h"
#include "tree/tree_scenes.h"

namespace splotchcl::test {
namespace {

class TreeFile : public ::testing::Test {
 protected:
  TreeFile() {
    const Matter matter = clumps(5000, 11);
    tree_ = build_tree(source_of(matter), {});
    TestSnapshot content;
    content.counts[0] = 5000;
    content.total_counts[0] = 5000;
    content.table_masses[0] = 1;
    TestBlock positions;
    positions.label = "POS ";
    positions.values_per_particle = 3;
    positions.types = 1;
    positions.values.resize(6);
    positions.values[0].assign(matter.position.begin(), matter.position.end());
    content.blocks = {positions};
    write_gadget(folder_ / "clumps", content, 2);
  }

  SnapshotInfo info() const { return open_snapshot(folder_ / "clumps")->info(); }
  std::filesystem::path path() const { return folder_ / "clumps.splotchcl_tree"; }
  std::string bytes() const {
    std::ifstream file(path(), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void write_bytes(const std::string& bytes) const {
    std::ofstream(path(), std::ios::binary) << bytes;
  }

  TemporaryFolder folder_;
  TreeOfType tree_;
};

TEST_F(TreeFile, HoldsWhatWasWritten) {
  write_trees(info(), {tree_});
  const auto trees = read_trees(info());
  ASSERT_TRUE(trees);
  ASSERT_EQ(trees->size(), 1u);
  const TreeOfType& read = *trees->front();
  EXPECT_EQ(read.count, tree_.count);
  EXPECT_EQ(read.side, tree_.side);
  EXPECT_EQ(read.fields, tree_.fields);
  ASSERT_EQ(read.levels.size(), tree_.levels.size());
  const TreeLevel& last = read.levels.back();
  EXPECT_EQ(last.count, tree_.levels.back().count);
  EXPECT_EQ(last.nodes[last.count - 1].flux, tree_.levels.back().nodes[last.count - 1].flux);
  EXPECT_EQ(read.order[tree_.order_count - 1], tree_.order[tree_.order_count - 1]);
}

TEST_F(TreeFile, IsNotReadOnceTheSnapshotHasChanged) {
  write_trees(info(), {tree_});
  const std::filesystem::path snapshot = folder_ / "clumps";
  std::filesystem::last_write_time(
      snapshot, std::filesystem::last_write_time(snapshot) + std::chrono::seconds(5));
  EXPECT_FALSE(read_trees(info()));
  EXPECT_TRUE(tree_is_there(info()));
}

TEST_F(TreeFile, IsNotReadWhereAByteIsDamagedOrTheEndIsMissing) {
  write_trees(info(), {tree_});
  const std::string whole = bytes();
  for (std::size_t at = 0; at < whole.size(); at += 1 + whole.size() / 97) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 16);
    write_bytes(damaged);
    EXPECT_FALSE(read_trees(info())) << "byte " << at;
    write_bytes(whole.substr(0, at));
    EXPECT_FALSE(read_trees(info())) << "cut to " << at;
  }
  write_bytes(whole);
  EXPECT_TRUE(read_trees(info()));
}

TEST_F(TreeFile, DoesNotReplaceAnotherFile) {
  write_bytes("someone's notes");
  EXPECT_THROW(write_trees(info(), {tree_}), UsageError);
  EXPECT_EQ(bytes(), "someone's notes");
}

}  // namespace
}  // namespace splotchcl::test
