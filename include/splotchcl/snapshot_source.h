#pragma once

#include <memory>

namespace splotchcl {

struct Scene;
class Snapshot;

// Gives the snapshot of each frame. Of a sequence the two around the frame are kept in
// memory, and from the second frame on the next one is read ahead by a thread.
// Use from one thread at a time.
class SnapshotSource {
 public:
  SnapshotSource();
  ~SnapshotSource();
  SnapshotSource(SnapshotSource&&) noexcept;
  SnapshotSource& operator=(SnapshotSource&&) noexcept;

  // The scene's only snapshot, or what scene.time says. Where the index is that of a
  // snapshot, the result holds exactly what the file does. The same scene gives the same
  // object. Throws UsageError for an index outside of the sequence and interpolation that the
  // snapshots do not allow, DataError for snapshots that cannot be read or have no particle
  // in common.
  std::shared_ptr<const Snapshot> at(const Scene& scene);

  // Looks at all snapshots of a sequence: each can be opened, and shares particles with the
  // next one. Reads all ids. For films, before their first frame. Throws like at().
  void check(const Scene& scene);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace splotchcl
