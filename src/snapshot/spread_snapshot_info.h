#pragma once

#include <string>
#include <vector>

#include "splotchcl/snapshot.h"
#include "splotchcl/vector.h"

namespace splotchcl {

// What a rank tells the others of its part of a snapshot that is spread over them.
struct SnapshotPart {
  SnapshotInfo info;  // types, time, box size
  Vec3 origin = {{0, 0, 0}};
};
std::string packed(const SnapshotPart& part);
SnapshotPart unpacked(const std::string& text);

// The whole of which these are parts, by rank. Throws UsageError where they do not fit together.
SnapshotInfo whole_of(const std::vector<SnapshotPart>& parts);

}  // namespace splotchcl
