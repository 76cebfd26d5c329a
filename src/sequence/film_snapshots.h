#pragma once

#include <memory>

#include "snapshot/cached_snapshot.h"
#include "splotchcl/sequence.h"
#include "splotchcl/snapshot_source.h"

namespace splotchcl {

// The snapshots of a film's frames: each is opened once, and its columns are read once.
class FilmSnapshots {
 public:
  // As SnapshotSource.
  std::shared_ptr<const Snapshot> at(const Scene& scene);
  void check(const Scene& scene) { source_.check(scene); }

 private:
  SnapshotSource source_;
  // Of a scene with one snapshot; sequences remember by themselves.
  std::shared_ptr<const Snapshot> single_;
  std::shared_ptr<const CachedSnapshot> cached_;
};

}  // namespace splotchcl
