#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "film/follow/point_cloud.h"
#include "splotchcl/scene.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// The particles by which something is found in every snapshot, where they were chosen.
struct FollowedParticles {
  std::map<int, std::vector<std::uint64_t>> ids;  // in increasing order, by particle type
  Vec3 center = {{0, 0, 0}};
  double radius = 0;
};

// Chooses what the scene's path follows. `wants_ids`: there are other snapshots. Throws UsageError
// and DataError.
FollowedParticles choose_followed(const Scene& scene, const Snapshot& snapshot, bool wants_ids);

// Some of them as a snapshot has them.
struct FoundParticles {
  PointCloud cloud;
  std::vector<std::size_t> numbers;  // of each, among all that are followed
  std::vector<Vec3> velocities;      // as many, or none
};
// Those of these ids; with velocities if they are asked for. Throws UsageError where there are
// none.
FoundParticles find_particles(const FollowedParticles& followed, const Snapshot& snapshot,
                              bool wants_velocities);

// The periodic box that the particles fill, if there is one.
std::optional<BoxSides> filled_box(const Scene& scene, const Snapshot& snapshot);

}  // namespace splotchcl
