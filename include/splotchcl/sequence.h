#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace splotchcl {

struct Scene;
class Snapshot;

// Between two snapshots (docs/time.md):
//   none     the earlier of the two as it is
//   linear   positions on straight lines, fields linear or logarithmic
//   hermite  positions on the cubic that has both snapshots' velocities at its ends
enum class Interpolation { none, linear, hermite };

// Snapshots that follow each other, and the moment between them that is drawn.
struct SequenceSettings {
  // One of the two; both empty: the scene has a single snapshot.
  std::vector<std::string> snapshots;  // index 0, 1, 2, ...
  std::string pattern;                 // "snapshot_%03d": the index is the number in the name
  std::optional<int> first, last;      // of a pattern's numbers; unset: all that exist
  double index = 0;                    // with a fraction: between two snapshots
  Interpolation interpolation = Interpolation::linear;
  // Instead of what the snapshots say of their cosmology. hubble_rate is H0 in their unit of
  // velocity over their unit of length: 0.1 for km/s and kpc/h.
  std::optional<double> omega_matter, omega_lambda, hubble_rate;

  bool is_set() const { return !snapshots.empty() || !pattern.empty(); }
};

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
