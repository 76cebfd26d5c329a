#pragma once

#include <vector>

#include "film/path/followed_way.h"
#include "splotchcl/scene.h"

namespace splotchcl {

// Where what the scene's path.follow says is in the snapshots that a film needs in which all of
// these indices are drawn. It is looked up among the particles that the scene draws, in one
// snapshot, and found in the others by the ids of its inner part. Reads positions and ids of all of
// these snapshots, one after the other. Throws UsageError where there is nothing to follow or no
// ids, DataError for snapshots and catalogs that cannot be read.
FollowedWay find_followed(const Scene& scene, const std::vector<double>& indices);

}  // namespace splotchcl
