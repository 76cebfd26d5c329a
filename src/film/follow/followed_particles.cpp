#include "film/follow/followed_particles.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>
#include <cstddef>
#include <memory>
#include <set>
#include <string>

#include "load/periodic.h"
#include "load/select_particles.h"
#include "load/type_fields.h"
#include "snapshot/field_names.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

// Those that the scene draws of its own snapshot.
std::set<int> types_of(const Scene& scene, const Snapshot& snapshot) {
  std::set<int> types;
  for (const Component& component : scene.components) {
    for (const int type : component.types) {
      if (is_in_the_box(component) && snapshot.info().find_type(type) != nullptr)
        types.insert(type);
    }
  }
  return types;
}

// Particles and where each is among those of its type.
struct Candidates {
  PointCloud cloud;
  std::vector<std::size_t> places;
  std::vector<int> types;
};

Vec3 vector_at(const Column& column, std::size_t i) {
  return {{static_cast<double>(column[3 * i]), static_cast<double>(column[3 * i + 1]),
           static_cast<double>(column[3 * i + 2])}};
}

void add(const Snapshot& snapshot, int type, const ParticleIndices* chosen, Candidates& all) {
  const Column position = snapshot.read(type, "position");
  const Vec3 origin = snapshot.position_origin();
  const std::size_t count = chosen != nullptr ? chosen->size() : position.size() / 3;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t place = chosen != nullptr ? (*chosen)[i] : i;
    const Vec3 point = origin + vector_at(position, place);
    if (!std::isfinite(boost::qvm::mag(point))) continue;
    all.cloud.points.push_back(point);
    all.places.push_back(place);
    all.types.push_back(type);
  }
}

// All that is drawn, or those of a halo or a sphere.
Candidates candidates(const Scene& scene, const Snapshot& snapshot, const ParticleSet& set) {
  Candidates all;
  all.cloud.box = filled_box(scene, snapshot);
  Component selecting;
  selecting.select = set;
  for (const int type : types_of(scene, snapshot)) {
    const TypeFields fields(snapshot, *snapshot.info().find_type(type), "path.follow", {{0, 0, 0}},
                            [](const std::string&) {});
    const auto chosen = select_particles(selecting, fields, snapshot, all.cloud.box);
    add(snapshot, type, chosen.get(), all);
  }
  return all;
}

[[noreturn]] void refuse_empty(const Follow& follow, const Snapshot& snapshot) {
  throw UsageError(fmt::format(
      "path.follow: found no particle that the scene draws in the {} in {}, expected some",
      follow.halo ? fmt::format("halo {}", *follow.halo) : "sphere",
      snapshot.info().files.front().string()));
}

// A halo's center is the median of its particles, and its radius holds nearly all.
void measure_halo(const Candidates& members, FollowedParticles& followed) {
  constexpr double nearly_all = 0.9;
  followed.center = middle_of(members.cloud, members.cloud.points.front());
  followed.radius = radius_of_part(members.cloud, followed.center, nearly_all);
}

ParticleSet sphere_of(const Scene& scene, const Snapshot& snapshot) {
  const Follow& follow = *scene.path.follow;
  ParticleSet sphere;
  sphere.sphere_center = follow.sphere_center;
  sphere.sphere_radius = follow.sphere_radius;
  if (follow.sphere_center && follow.sphere_radius) return sphere;
  const Candidates all = candidates(scene, snapshot, {});
  if (all.cloud.points.empty()) refuse_empty(follow, snapshot);
  if (!sphere.sphere_center) sphere.sphere_center = densest_point(all.cloud);
  if (!sphere.sphere_radius) sphere.sphere_radius = dense_radius(all.cloud, *sphere.sphere_center);
  return sphere;
}

void keep_ids(const Candidates& all, const Snapshot& snapshot, FollowedParticles& followed) {
  std::map<int, std::vector<std::uint64_t>> ids_of_type;
  for (std::size_t i = 0; i < all.places.size(); ++i) {
    const int type = all.types[i];
    if (ids_of_type.count(type) == 0) ids_of_type[type] = snapshot.read_ids(type);
    followed.ids[type].push_back(ids_of_type[type].at(all.places[i]));
  }
  for (auto& [type, ids] : followed.ids)
    std::sort(ids.begin(), ids.end());
}

}  // namespace

std::optional<BoxSides> filled_box(const Scene& scene, const Snapshot& snapshot) {
  const std::optional<BoxSides> box =
      scene.periodic.box ? scene.periodic.box : snapshot.info().box_size;
  if (!box || !box->are_lengths()) return std::nullopt;
  PositionExtent extent;
  for (const int type : types_of(scene, snapshot))
    extent.take(extent_of_type(snapshot, type));
  if (!lies_in_one_period(extent, *box)) return std::nullopt;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!fills_box(extent, *box, axis)) return std::nullopt;
  }
  return box;
}

FollowedParticles choose_followed(const Scene& scene, const Snapshot& snapshot, bool wants_ids) {
  const Follow& follow = *scene.path.follow;
  ParticleSet set;
  if (follow.halo) {
    set.halo = follow.halo;
    set.halo_catalog = follow.catalog;
  } else {
    set = sphere_of(scene, snapshot);
  }
  const Candidates members = candidates(scene, snapshot, set);
  if (members.cloud.points.empty()) refuse_empty(follow, snapshot);
  FollowedParticles followed;
  if (follow.halo) {
    measure_halo(members, followed);
  } else {
    followed.radius = *set.sphere_radius;
    followed.center = core_of(members.cloud, *set.sphere_center, followed.radius);
  }
  if (wants_ids) keep_ids(members, snapshot, followed);
  return followed;
}

FoundParticles find_particles(const FollowedParticles& followed, const Snapshot& snapshot,
                              bool wants_velocities) {
  FoundParticles found;
  std::size_t first = 0;  // of a type, among all
  for (const auto& [type, wanted] : followed.ids) {
    const std::size_t first_of_type = first;
    first += wanted.size();
    if (snapshot.info().find_type(type) == nullptr) continue;
    const std::vector<std::uint64_t> ids = snapshot.read_ids(type);
    const Column position = snapshot.read(type, "position");
    const Column velocity = wants_velocities ? snapshot.read(type, "velocity") : Column();
    const Vec3 origin = snapshot.position_origin();
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const auto place = std::lower_bound(wanted.begin(), wanted.end(), ids[i]);
      if (place == wanted.end() || *place != ids[i]) continue;
      const Vec3 point = origin + vector_at(position, i);
      if (!std::isfinite(boost::qvm::mag(point))) continue;
      found.cloud.points.push_back(point);
      found.numbers.push_back(first_of_type + static_cast<std::size_t>(place - wanted.begin()));
      if (wants_velocities) found.velocities.push_back(vector_at(velocity, i));
    }
  }
  if (!found.cloud.points.empty()) return found;
  throw UsageError(fmt::format(
      "path.follow: found none of the particles that are followed in {}, expected some; choose "
      "them in a snapshot that shares particles with it, by path.follow.snapshot",
      snapshot.info().files.front().string()));
}

}  // namespace splotchcl
