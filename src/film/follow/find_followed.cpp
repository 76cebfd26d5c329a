#include <fmt/format.h>

#include <algorithm>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numeric>
#include <optional>

#include "film/follow/followed_particles.h"
#include "sequence/snapshot_source.h"
#include "splotchcl/error.h"
#include "splotchcl/snapshot_source.h"

namespace splotchcl {
namespace {

using namespace boost::qvm;

// Places, among these particles, of those that are nearest to a point.
std::vector<std::size_t> nearest(const PointCloud& cloud, const Vec3& center, std::size_t count) {
  std::vector<std::size_t> places(cloud.points.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  std::vector<double> distances;
  for (const Vec3& point : cloud.points)
    distances.push_back(mag(cloud.offset(center, point)));
  const auto end = places.begin() + static_cast<std::ptrdiff_t>(count);
  std::partial_sort(places.begin(), end, places.end(),
                    [&](std::size_t a, std::size_t b) { return distances[a] < distances[b]; });
  places.erase(end, places.end());
  return places;
}

// Angular momentum of the innermost fifth, of particles of the same mass, of length 1.
Vec3 spin_of(const FoundParticles& found, const Vec3& center) {
  const std::size_t all = found.velocities.size();
  const std::vector<std::size_t> inner =
      nearest(found.cloud, center, std::max(core_count(all), all / 5));
  Vec3 mean = {{0, 0, 0}}, spin = {{0, 0, 0}};
  for (const std::size_t i : inner)
    mean += found.velocities[i] / static_cast<double>(inner.size());
  for (const std::size_t i : inner) {
    spin +=
        cross(found.cloud.offset(center, found.cloud.points[i]), Vec3(found.velocities[i] - mean));
  }
  if (mag(spin) > 0 && std::isfinite(mag(spin))) return normalized(spin);
  throw UsageError(
      "path.follow.up: found particles without angular momentum, expected some that turn; leave it "
      "out");
}

// Where it is looked for: from before the first to after the last moment of a film.
struct Search {
  std::vector<double> indices;  // rising
  double chosen = 0;            // the snapshot's in which the particles are chosen
};

// Between snapshots particles move as the film draws them, each on a way of its own: their median
// is looked for at so many places.
constexpr int places_between = 8;

void add_between(double from, double to, Interpolation interpolation,
                 std::vector<double>& indices) {
  const int places = interpolation == Interpolation::none ? 1 : places_between;
  for (int i = 0; i < places; ++i)
    indices.push_back(from + (to - from) * i / places);
}

// The snapshot at an index, or after it.
std::size_t end_of(const std::vector<ListedSnapshot>& list, double index) {
  const SequencePlace place = find_place(list, index);
  return place.snapshot + (place.fraction > 0 ? 1 : 0);
}

double index_of_choice(const Follow& follow, const std::vector<ListedSnapshot>& list,
                       std::size_t last) {
  if (!follow.snapshot) return list[last].index;
  try {
    return list[end_of(list, *follow.snapshot)].index;
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("path.follow.snapshot: {}", error.what()));
  }
}

Search search_for(const Scene& scene, const std::vector<double>& indices) {
  const std::vector<ListedSnapshot> list = list_sequence(scene.time);
  const auto [least, most] = std::minmax_element(indices.begin(), indices.end());
  const std::size_t first = find_place(list, *least).snapshot, last = end_of(list, *most);
  Search search;
  for (std::size_t i = first; i < last; ++i)
    add_between(list[i].index, list[i + 1].index, scene.time.interpolation, search.indices);
  search.indices.push_back(list[last].index);
  search.chosen = index_of_choice(*scene.path.follow, list, last);
  return search;
}

class Followers {
 public:
  Followers(const Scene& scene, const Search& search)
      : scene_(scene), followed_(choose_followed(scene, *at(search.chosen), true)) {}

  // From where it was chosen forwards, and backwards: each time it is near to where it was.
  FollowedWay way(const Search& search) {
    const auto chosen =
        std::lower_bound(search.indices.begin(), search.indices.end(), search.chosen);
    Track track = {followed_.center, {}};
    if (chosen == search.indices.end() || *chosen != search.chosen)
      (void)moment_at(search.chosen, track);
    std::vector<FollowedMoment> moments;
    Track later = track;
    for (auto index = chosen; index != search.indices.end(); ++index) {
      moments.push_back(moment_at(*index, later));
      if (*index == search.chosen) track = later;
    }
    for (auto index = chosen; index != search.indices.begin();)
      moments.push_back(moment_at(*--index, track));
    std::sort(moments.begin(), moments.end(),
              [](const auto& a, const auto& b) { return a.index < b.index; });
    return FollowedWay(moments, followed_.radius, kind());
  }

 private:
  FollowedWay::Kind kind() const {
    switch (scene_.time.interpolation) {
      case Interpolation::none:
        return FollowedWay::Kind::steps;
      case Interpolation::linear:
        return FollowedWay::Kind::straight;
      case Interpolation::hermite:
        break;
    }
    return FollowedWay::Kind::smooth;
  }

  std::shared_ptr<const Snapshot> at(double index) {
    Scene moment = scene_;
    moment.time.index = index;
    return source_.at(moment);
  }

  // Where it was last, and which of its particles were in its middle.
  struct Track {
    Vec3 center;
    std::vector<bool> is_core;  // by number; empty: not known yet
  };

  FollowedMoment moment_at(double index, Track& track) {
    const std::shared_ptr<const Snapshot> snapshot = at(index);
    const bool turns = scene_.path.follow->up == Follow::Up::angular_momentum;
    FoundParticles found = find_particles(followed_, *snapshot, turns);
    found.cloud.box = filled_box(scene_, *snapshot);
    FollowedMoment moment;
    moment.index = index;
    moment.center = core_of(found.cloud, start_of(found, track), 2 * followed_.radius);
    if (turns) moment.up = spin_of(found, moment.center);
    track.center = moment.center;
    track.is_core.assign(followed_count(), false);
    for (const std::size_t i :
         nearest(found.cloud, moment.center, core_count(found.cloud.points.size())))
      track.is_core[found.numbers[i]] = true;
    return moment;
  }

  // What was in the middle is there still, or nearly.
  static Vec3 start_of(const FoundParticles& found, const Track& track) {
    if (track.is_core.empty()) return track.center;
    PointCloud core;
    core.box = found.cloud.box;
    for (std::size_t i = 0; i < found.numbers.size(); ++i) {
      if (track.is_core[found.numbers[i]]) core.points.push_back(found.cloud.points[i]);
    }
    return core.points.empty() ? track.center : middle_of(core, track.center);
  }

  std::size_t followed_count() const {
    std::size_t count = 0;
    for (const auto& [type, ids] : followed_.ids)
      count += ids.size();
    return count;
  }

  const Scene& scene_;
  SnapshotSource source_;
  FollowedParticles followed_;
};

FollowedWay in_single_snapshot(const Scene& scene) {
  const std::shared_ptr<const Snapshot> snapshot = SnapshotSource().at(scene);
  const bool turns = scene.path.follow->up == Follow::Up::angular_momentum;
  const FollowedParticles followed = choose_followed(scene, *snapshot, turns);
  FollowedMoment moment;
  moment.center = followed.center;
  if (turns) {
    FoundParticles found = find_particles(followed, *snapshot, true);
    found.cloud.box = filled_box(scene, *snapshot);
    moment.up = spin_of(found, moment.center);
  }
  return FollowedWay({moment}, followed.radius, FollowedWay::Kind::steps);
}

}  // namespace

FollowedWay find_followed(const Scene& scene, const std::vector<double>& indices) {
  if (!scene.time.is_set()) return in_single_snapshot(scene);
  const Search search = search_for(scene, indices);
  return Followers(scene, search).way(search);
}

}  // namespace splotchcl
