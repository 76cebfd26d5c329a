#include "testing.h"
#include "tree/tree_cut.h"
#include "tree/tree_scenes.h"

namespace splotchcl::test {
namespace {

// Copies of a tree's arrays, of which some bytes are others: files of more than a gigabyte are
// not looked at as a whole before they are used.
class DamagedTree {
 public:
  DamagedTree(const TreeOfType& whole, std::uint64_t seed) : tree_(whole), random_(seed) {
    const std::size_t fields = whole.fields.size();
    for (TreeLevel& level : tree_.levels) {
      const std::size_t groups = (level.count + TreeLevel::group - 1) / TreeLevel::group;
      replace(level.nodes, level.count);
      replace(level.fields, level.count * fields);
      replace(level.children, level.count);
      replace(level.loose, level.count);
      replace(level.first_children, groups);
      replace(level.first_loose, groups);
    }
    replace(tree_.order, tree_.order_count);
    tree_.owner = nullptr;
  }
  const TreeOfType& tree() const { return tree_; }

 private:
  template <class T>
  void replace(const T*& array, std::size_t count) {
    std::vector<std::uint8_t>& copy = memory_.emplace_back(count * sizeof(T));
    if (count == 0) return;
    std::memcpy(copy.data(), array, copy.size());
    std::uniform_int_distribution<std::size_t> place(0, copy.size() - 1);
    for (int damaged = 0; damaged < 2; ++damaged) {
      if (random_() % 4 == 0) copy[place(random_)] = static_cast<std::uint8_t>(random_());
    }
    array = reinterpret_cast<const T*>(copy.data());
  }

  TreeOfType tree_;
  std::mt19937_64 random_;
  std::vector<std::vector<std::uint8_t>> memory_;
};

TEST(DamagedTrees, AreCutToPlacesOfParticlesOrRefused) {
  const Matter matter = clumps(3000, 41);
  const auto whole = tree_of(matter);
  int refused = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const DamagedTree damaged(*whole, seed);
    Frame frame = frame_of(matter, 20, 15);
    plant(frame, std::shared_ptr<const TreeOfType>(&damaged.tree(), [](const auto*) {}));
    try {
      const TreeCut cut = cut_tree(frame, {seed % 2 == 0 ? 0 : 1e-3, {}, 1});
      EXPECT_LE(cut.nodes, 3 * whole->node_count());
    } catch (const DataError& error) {
      ++refused;
      EXPECT_THAT(error.what(), HasSubstr("splotchcl tree wrote"));
    }
  }
  EXPECT_GT(refused, 10);
}

}  // namespace
}  // namespace splotchcl::test
