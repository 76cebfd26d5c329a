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
    source_ = source_of(matter);
    source_.colors = ColorRule{0, -1, {Scaling::log, -2, 2}, {}, {"", {{0, 0, 1}, {1, 0, 0}}, {}}};
    tree_ = build_tree(source_, {});
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
  TreeSource source_;
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
  EXPECT_EQ(read.colors, source_.colors->key());
  ASSERT_EQ(read.levels.size(), tree_.levels.size());
  const TreeLevel& last = read.levels.back();
  EXPECT_EQ(last.count, tree_.levels.back().count);
  EXPECT_EQ(last.nodes[last.count - 1].flux, tree_.levels.back().nodes[last.count - 1].flux);
  EXPECT_EQ(last.colors[last.count - 1].mean(), tree_.levels.back().colors[last.count - 1].mean());
  EXPECT_EQ(read.order[tree_.order_count - 1], tree_.order[tree_.order_count - 1]);
}

TEST_F(TreeFile, HoldsParticlesInItsOrder) {
  write_trees(info(), {tree_}, {source_});
  const auto trees = read_trees(info());
  ASSERT_TRUE(trees);
  const TreeOfType& read = *trees->front();
  ASSERT_TRUE(read.particles);
  EXPECT_EQ(read.order, nullptr);
  ASSERT_EQ(read.order_count, tree_.order_count);
  const StoredParticles& particles = *read.particles;
  ASSERT_EQ(particles.fields.size(), 1U);
  for (std::uint64_t i = 0; i < read.order_count; ++i) {
    const std::uint32_t place = tree_.order[i];
    ASSERT_EQ(particles.position[3 * i + 2], source_.position[3 * place + 2]);
    ASSERT_EQ(particles.smoothing_length[i], source_.smoothing_length[place]);
    ASSERT_EQ(particles.weight[i], source_.weights[place]);
    ASSERT_EQ(particles.fields[0][i], source_.fields[0].values[place]);
  }
}

TEST_F(TreeFile, HoldsOneWeightForAllOnce) {
  source_.weights = Column::uniform(2.5F);
  write_trees(info(), {tree_}, {source_});
  const auto trees = read_trees(info());
  ASSERT_TRUE(trees);
  const Column& weight = trees->front()->particles->weight;
  ASSERT_TRUE(weight.is_uniform());
  EXPECT_EQ(weight.uniform_value(), 2.5F);
}

TEST_F(TreeFile, HoldsASampleOfParticles) {
  ParticleSample sample;
  sample.stride = 2000;
  sample.origin = {{1, 2, 3}};
  sample.particles.position = Column::owning({1, 2, 3, 4, 5, 6, 7, 8, 9});
  sample.particles.smoothing_length = Column::owning({2, 3, 4});
  sample.particles.weight = Column::uniform(2.5F);
  sample.particles.fields = {Column::owning({5, 6, 7})};
  sample.other_names = {"density"};
  sample.others = {Column::uniform(8)};
  tree_.sample = sample;
  write_trees(info(), {tree_}, {source_});
  const auto trees = read_trees(info());
  ASSERT_TRUE(trees);
  ASSERT_TRUE(trees->front()->particles);
  ASSERT_TRUE(trees->front()->sample);
  const ParticleSample& read = *trees->front()->sample;
  EXPECT_EQ(read.stride, 2000U);
  EXPECT_EQ(read.origin.a[2], 3);
  EXPECT_EQ(read.particles.position[8], 9);
  EXPECT_EQ(read.particles.smoothing_length[2], 4);
  EXPECT_EQ(read.particles.weight.uniform_value(), 2.5F);
  EXPECT_EQ(read.particles.fields.at(0)[1], 6);
  EXPECT_EQ(read.other_names, sample.other_names);
  EXPECT_EQ(read.others.at(0)[2], 8);
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
  write_trees(info(), {tree_}, {source_});
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
