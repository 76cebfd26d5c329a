// Trees of merged particles with whatever numbers in them, as files of more than a gigabyte may
// have them: each is cut, or refused.
#include <cstring>
#include <memory>
#include <vector>

#include "fuzz/fuzz.h"
#include "tree/tree_cut.h"
#include "tree/tree_scenes.h"

namespace {

using namespace splotchcl;

// Copies of a tree's arrays, over which bytes of the input are laid.
class ChangedTree {
 public:
  explicit ChangedTree(const TreeOfType& whole) : tree_(whole) {
    for (TreeLevel& level : tree_.levels) {
      const std::size_t groups = (level.count + TreeLevel::group - 1) / TreeLevel::group;
      copy(level.nodes, level.count);
      copy(level.fields, level.count * whole.fields.size());
      copy(level.children, level.count);
      copy(level.loose, level.count);
      copy(level.first_children, groups);
      copy(level.first_loose, groups);
    }
    copy(tree_.order, tree_.order_count);
    tree_.owner = nullptr;
  }
  // Three bytes of input say where, the fourth what.
  void change(const std::uint8_t* input) {
    std::vector<std::uint8_t>& bytes = memory_[input[0] % memory_.size()];
    const std::size_t place = input[1] * std::size_t{256} + input[2];
    if (!bytes.empty()) bytes[place % bytes.size()] = input[3];
  }
  const TreeOfType& tree() const { return tree_; }

 private:
  template <class T>
  void copy(const T*& array, std::size_t count) {
    std::vector<std::uint8_t>& bytes = memory_.emplace_back(count * sizeof(T));
    if (count > 0) std::memcpy(bytes.data(), array, bytes.size());
    array = reinterpret_cast<const T*>(bytes.data());
  }

  TreeOfType tree_;
  std::vector<std::vector<std::uint8_t>> memory_;
};

}  // namespace

void splotchcl::fuzz::fuzz_tree(const std::uint8_t* data, std::size_t size) {
  static const test::Matter matter = test::clumps(300, 1);
  static const auto whole = test::tree_of(matter);
  ChangedTree changed(*whole);
  for (std::size_t at = 0; at + 4 <= size; at += 4)
    changed.change(data + at);
  Frame frame = test::frame_of(matter, 16, 12);
  test::plant(frame, std::shared_ptr<const TreeOfType>(&changed.tree(), [](const auto*) {}));
  for (const double error : {0.0, 1e-3}) {
    try {
      cut_tree(frame, {error, {}, 1});
    } catch (const Error&) {
    }
  }
}
