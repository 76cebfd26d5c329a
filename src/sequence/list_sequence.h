#pragma once

#include <vector>

#include "snapshot/snapshot_files.h"

namespace splotchcl {

// The snapshots of a sequence that exist, by rising index. As list_snapshots, but a pattern may
// lead into a file, to its steps in time: run.h5/Step#%d, openpmd.h5/data/%d. Throws UsageError.
std::vector<ListedSnapshot> list_sequence(const SequenceSettings& settings);

}  // namespace splotchcl
