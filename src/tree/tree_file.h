#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "splotchcl/snapshot.h"
#include "tree/build_tree.h"
#include "tree/particle_tree.h"

namespace splotchcl {

// The file beside a snapshot, for the first of its files snapshot_006.splotchcl_tree, that
// `splotchcl tree` writes: a tree for each type. It is used only as long as size and time of every
// file of the snapshot are those that it was made of.
std::filesystem::path tree_path(const SnapshotInfo& info);

// Whether a snapshot's particles are where its files have them, all of them.
bool tree_is_of_use(const SnapshotInfo& info);
// Whether there is one beside the snapshot: stale, where read_trees() does not take it.
bool tree_is_there(const SnapshotInfo& info);

// Throws DataError when the file cannot be written or the snapshot was written anew since it was
// opened, UsageError when another file is in its place. `particles`, where there are some, are what
// each tree was made of: then values of loose ones lie in it, in its order, so that what is next to
// each other is read together.
void write_trees(const SnapshotInfo& info, const std::vector<TreeOfType>& trees,
                 const std::vector<TreeSource>& particles = {});

using Trees = std::vector<std::shared_ptr<const TreeOfType>>;
// Mapped, so that only what is looked at is read; the checksums of files up to a gigabyte are
// looked at as a whole, of larger ones that of the header. None where there is no such file, it is
// damaged, or of other files than the snapshot's.
std::optional<Trees> read_trees(const SnapshotInfo& info);

}  // namespace splotchcl
