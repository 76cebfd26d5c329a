#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "film/path/followed_way.h"
#include "splotchcl/periodic.h"
#include "splotchcl/scene.h"
#include "splotchcl/snapshot.h"
#include "splotchcl/vector.h"

namespace splotchcl {

// Particles of a snapshot as points, all finite; with the periodic box that they fill, if any.
struct PointCloud {
  std::vector<Vec3> points;
  std::optional<BoxSides> box;

  // From `from` to the nearest image of a point.
  Vec3 offset(const Vec3& from, const Vec3& point) const;
};

// Where the points lie closest, found in finer and finer cells and then in smaller and smaller
// spheres. Needs a point.
Vec3 densest_point(const PointCloud& cloud);

// Of the sphere around a dense point that is 200 times as dense as the points in the mean; where
// none is, of the hundredth of all that is nearest.
double dense_radius(const PointCloud& cloud, const Vec3& center);

// A tenth of so many points, but a hundred at least, or all: those that tell where a cloud is.
std::size_t core_count(std::size_t points);

// Where most points are, by the means of smaller and smaller spheres, from one of this radius about
// `start` to one that holds the core. What else there is does not count.
Vec3 core_of(const PointCloud& cloud, const Vec3& start, double radius);

// The median along each axis, to which outliers do not count: `guess` must be nearer to the points
// than half of the box. In a periodic box the image nearest to the guess. Needs a point.
Vec3 middle_of(const PointCloud& cloud, const Vec3& guess);

// Of points and a center: how far the nearest `part` of them reach.
double radius_of_part(const PointCloud& cloud, const Vec3& center, double part);

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

// Where what the scene's path.follow says is in the snapshots that a film needs in which all of
// these indices are drawn. It is looked up among the particles that the scene draws, in one
// snapshot, and found in the others by the ids of its inner part. Reads positions and ids of all of
// these snapshots, one after the other. Throws UsageError where there is nothing to follow or no
// ids, DataError for snapshots and catalogs that cannot be read.
FollowedWay find_followed(const Scene& scene, const std::vector<double>& indices);

}  // namespace splotchcl
