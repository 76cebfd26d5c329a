#pragma once

#include <memory>
#include <vector>

#include "snapshot/derived_snapshots.h"
#include "snapshot/snapshot_files.h"
#include "splotchcl/scene.h"
#include "splotchcl/sequence.h"
#include "splotchcl/snapshot_source.h"

namespace splotchcl {

// The snapshots of a sequence that exist, by rising index. As list_snapshots, but a pattern may
// lead into a file, to its steps in time: run.h5/Step#%d, openpmd.h5/data/%d. Throws UsageError.
std::vector<ListedSnapshot> list_sequence(const SequenceSettings& settings);

// The snapshots of a film's frames: each is opened once, and its columns are read once.
class FilmSnapshots {
 public:
  // As SnapshotSource.
  std::shared_ptr<const Snapshot> at(const Scene& scene) {
    std::shared_ptr<const Snapshot> snapshot = source_.at(scene);
    if (scene.time.is_set()) return snapshot;
    if (single_ != snapshot) {
      single_ = snapshot;
      cached_ = std::make_shared<CachedSnapshot>(snapshot);
    }
    return cached_;
  }
  void check(const Scene& scene) { source_.check(scene); }

 private:
  SnapshotSource source_;
  // Of a scene with one snapshot; sequences remember by themselves.
  std::shared_ptr<const Snapshot> single_;
  std::shared_ptr<const CachedSnapshot> cached_;
};

}  // namespace splotchcl
