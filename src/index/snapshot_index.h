#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "splotchcl/snapshot.h"

namespace splotchcl {

// Where the particles of a snapshot are: of each type boxes around blocks of them that follow each
// other in the file, and the largest smoothing length of each block. `splotchcl index` keeps it in
// a file beside the snapshot, for the first of its files snapshot_006.splotchcl_index. It is used
// only as long as size and time of every file of the snapshot are those that it was made of.
class SnapshotIndex {
 public:
  static constexpr std::size_t block_particles = 8192;

  struct Type {
    int type = 0;
    std::uint64_t count = 0;
    bool has_smoothing_lengths = false;  // else those of the boxes are 0
    // Relative to the snapshot's position_origin(). A block that holds a particle whose position or
    // smoothing length is bad has no end.
    std::vector<ParticleBox> boxes;
  };

  static std::filesystem::path path_for(const SnapshotInfo& info);

  // Reads all positions and smoothing lengths. Throws UsageError where a snapshot has no files
  // whose parts can be read alone, as tables of text and NumPy's arrays, or is a part of one.
  static SnapshotIndex make(const Snapshot& snapshot, const std::function<void(double)>& progress);
  // Of boxes that are known otherwise.
  static SnapshotIndex of(std::vector<Type> types);
  // That beside the snapshot; none where there is no such file, it is damaged or of other files, or
  // the files are others than when the snapshot was opened.
  static std::optional<SnapshotIndex> read(const SnapshotInfo& info);

  // Whether a snapshot's files are read in parts, so that an index saves something, and its
  // particles are where the files have them.
  static bool is_of_use(const SnapshotInfo& info);
  // Whether there is one beside the snapshot: stale, where read() does not take it.
  static bool is_there(const SnapshotInfo& info);

  // Throws DataError when the file cannot be written, or the snapshot has been written anew since
  // it was opened, UsageError when another one is in its place.
  void write(const SnapshotInfo& info) const;

  const std::vector<Type>& types() const { return types_; }
  const Type* find(int type) const;  // null where it is not there

 private:
  std::vector<Type> types_;
};

}  // namespace splotchcl
