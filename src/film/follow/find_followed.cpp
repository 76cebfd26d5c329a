#include "film/follow/find_followed.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>

#include "film/follow/followed_particles.h"
#include "sequence/list_sequence.h"
#include "splotchcl/error.h"
#include "splotchcl/snapshot_source.h"

namespace splotchcl {
namespace {

using namespace boost::qvm;

// Angular momentum of particles of the same mass, of length 1.
Vec3 spin_of(const FoundParticles& found, const Vec3& center) {
  const auto count = static_cast<double>(found.velocities.size());
  Vec3 mean = {{0, 0, 0}}, spin = {{0, 0, 0}};
  for (const Vec3& velocity : found.velocities)
    mean += velocity / count;
  for (std::size_t i = 0; i < found.velocities.size(); ++i) {
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
constexpr int places_between = 4;

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
    const auto middle =
        std::lower_bound(search.indices.begin(), search.indices.end(), search.chosen);
    std::vector<FollowedMoment> moments;
    look_into({middle, search.indices.end()}, moments);
    std::vector<double> earlier(search.indices.begin(), middle);
    std::reverse(earlier.begin(), earlier.end());
    look_into(earlier, moments);
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

  void look_into(const std::vector<double>& indices, std::vector<FollowedMoment>& moments) {
    Vec3 guess = followed_.center;
    for (const double index : indices) {
      moments.push_back(moment_at(index, guess));
      guess = moments.back().center;
    }
  }

  FollowedMoment moment_at(double index, const Vec3& guess) {
    const std::shared_ptr<const Snapshot> snapshot = at(index);
    const bool turns = scene_.path.follow->up == Follow::Up::angular_momentum;
    FoundParticles found = find_particles(followed_, *snapshot, turns);
    found.cloud.box = filled_box(scene_, *snapshot);
    FollowedMoment moment;
    moment.index = index;
    moment.center = middle_of(found.cloud, guess);
    if (turns) moment.up = spin_of(found, moment.center);
    return moment;
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
