#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "splotchcl/scene.h"
#include "splotchcl/snapshot.h"
#include "tree/build_tree.h"
#include "tree/tree_file.h"

namespace splotchcl::view {

// Makes a tree of merged particles (docs/tree.md) in memory, in a thread of its own, while one
// looks at a snapshot that has none: of the types and the fields that the scene shows.
class TreeMaker {
 public:
  // Of fewer particles a random part shows enough while the picture moves.
  static constexpr std::uint64_t fewest = 8000000;

  // Reads the columns, which the snapshot holds, in this thread. Makes nothing of fewer particles,
  // where there is a tree, or where the scene's time chooses the snapshot.
  TreeMaker(const Scene& scene, std::shared_ptr<const Snapshot> snapshot,
            std::uint64_t fewest_particles = fewest);
  // What is not done by then is given up.
  ~TreeMaker();
  TreeMaker(const TreeMaker&) = delete;
  TreeMaker& operator=(const TreeMaker&) = delete;

  // The trees, from when they are done on; null before, and where particles cannot be merged.
  const Trees* trees() const { return is_made_ ? &trees_ : nullptr; }
  bool is_at_work() const { return is_at_work_; }

 private:
  void make(const std::vector<TreeSource>& sources);

  std::shared_ptr<const Snapshot> snapshot_;  // whose memory the columns may be
  Trees trees_;                               // of the thread, until it is done
  std::atomic<bool> is_at_work_{false}, is_made_{false}, is_given_up_{false};
  std::thread thread_;
};

}  // namespace splotchcl::view
