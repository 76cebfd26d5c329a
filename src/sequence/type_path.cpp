#include "sequence/type_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>
#include <cstdint>
#include <set>
#include <vector>

#include "common/words.h"
#include "parallel/for_blocks.h"
#include "scene/ceil_divide.h"
#include "snapshot/field_names.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

[[noreturn]] void refuse(const SnapshotInfo& info, const std::string& what) {
  throw UsageError(
      fmt::format("time.interpolation is \"hermite\", which needs velocities, but {}: {}; set "
                  "time.interpolation to \"linear\", or say what is missing",
                  info.files.front().string(), what));
}

std::optional<Cosmology> cosmology_of(const SnapshotInfo& info, const SequenceSettings& settings) {
  std::optional<Cosmology> cosmology = info.cosmology;
  // The scene says that there is one where the snapshot does not.
  if (!cosmology && settings.omega_matter && info.time > 0) {
    cosmology.emplace();
    cosmology->scale_factor = info.time;
  }
  if (!cosmology) return std::nullopt;
  cosmology->omega_matter = settings.omega_matter.value_or(cosmology->omega_matter);
  cosmology->omega_lambda = settings.omega_lambda.value_or(cosmology->omega_lambda);
  cosmology->hubble_rate = settings.hubble_rate.value_or(cosmology->hubble_rate);
  return cosmology;
}

// da as a change of comoving position per stored velocity.
double comoving_rate(const Cosmology& cosmology, const SnapshotInfo& info) {
  const double a = cosmology.scale_factor;
  const double hubble =
      cosmology.hubble_rate * expansion_rate(a, cosmology.omega_matter, cosmology.omega_lambda);
  if (!(hubble > 0) || !std::isfinite(hubble)) {
    refuse(info,
           fmt::format("its expansion rate is not known (omega_matter {}, omega_lambda {}, "
                       "hubble_rate {})",
                       cosmology.omega_matter, cosmology.omega_lambda, cosmology.hubble_rate));
  }
  return std::pow(a, cosmology.velocity_power) / (a * a * hubble);
}

}  // namespace

double expansion_rate(double scale_factor, double omega_matter, double omega_lambda) {
  const double z1 = 1 / scale_factor;
  const double curvature = 1 - omega_matter - omega_lambda;
  return std::sqrt(omega_matter * z1 * z1 * z1 + curvature * z1 * z1 + omega_lambda);
}

Motion find_motion(const SnapshotInfo& first, const SnapshotInfo& second,
                   const SequenceSettings& settings) {
  const auto cosmology = cosmology_of(first, settings);
  const auto second_cosmology = cosmology_of(second, settings);
  Motion motion;
  // A run without cosmology may happen to stop at a time that fits its redshift of 0.
  if (cosmology && second_cosmology) {
    motion.first_time = cosmology->scale_factor;
    motion.second_time = second_cosmology->scale_factor;
    motion.first_rate = comoving_rate(*cosmology, first);
    motion.second_rate = comoving_rate(*second_cosmology, second);
  } else {
    for (const SnapshotInfo* const info : {&first, &second}) {
      if (!info->velocity_doubt.empty()) refuse(*info, info->velocity_doubt);
    }
    motion.first_time = first.time;
    motion.second_time = second.time;
  }
  if (motion.first_time == motion.second_time) {
    refuse(second, fmt::format("it has the same time, {}, as {}", motion.second_time,
                               first.files.front().string()));
  }
  return motion;
}

namespace {

constexpr std::size_t block_size = 65536;

using Point = std::array<double, 3>;

Point position_of(const PathEnd& end, std::size_t i) {
  Point point;
  for (std::size_t axis = 0; axis < 3; ++axis)
    point[axis] = end.origin.a[axis] + static_cast<double>(end.position[3 * i + axis]);
  return point;
}

Point tangent_of(const PathEnd& end, std::size_t i) {
  if (end.velocity.is_absent()) return {0, 0, 0};
  Point tangent;
  for (std::size_t axis = 0; axis < 3; ++axis)
    tangent[axis] = static_cast<double>(end.velocity[3 * i + axis]) * end.rate;
  return tangent;
}

double shorter_way(double displacement, std::size_t axis,
                   const std::optional<PeriodicRange>& period) {
  return period ? nearest_image(displacement, period->size[axis]) : displacement;
}

// Up to so much of a side beyond it particles have left the box since they were last put into it.
constexpr double just_left = 0.01;

bool lies_within(const Point& point, const PeriodicRange& range) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double lowest = range.lower.a[axis] - just_left * range.size[axis];
    const double highest = range.lower.a[axis] + (1 + just_left) * range.size[axis];
    // What is no number lies nowhere else.
    if (std::isfinite(point[axis]) && (point[axis] < lowest || point[axis] > highest)) return false;
  }
  return true;
}

std::uint64_t count_outside(const PathEnd& of, const PeriodicRange& range) {
  std::atomic<std::uint64_t> outside{0};
  for_blocks(of.position.size() / 3, block_size, [&](std::size_t begin, std::size_t end) {
    std::uint64_t of_block = 0;
    for (std::size_t i = begin; i < end; ++i)
      of_block += !lies_within(position_of(of, i), range);
    outside += of_block;
  });
  return outside;
}

// Sums of squares of particles in both.
struct Squares {
  double of_tangents = 0, of_ways = 0;
};

Squares squares_of(const TypePath& path, std::size_t a, std::size_t b) {
  const Point x0 = position_of(path.first, a), x1 = position_of(path.second, b);
  const Point m0 = tangent_of(path.first, a), m1 = tangent_of(path.second, b);
  Squares squares;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    squares.of_tangents += std::pow(0.5 * (m0[axis] + m1[axis]), 2);
    squares.of_ways += std::pow(shorter_way(x1[axis] - x0[axis], axis, path.period), 2);
  }
  return squares;
}

}  // namespace

ColumnBetween interpolate_positions(const TypePath& path, std::shared_ptr<const IdMatch> match,
                                    double fraction) {
  PathSetting setting;
  setting.first_origin = path.first.origin;
  setting.second_origin = path.second.origin;
  setting.first_rate = path.first.rate;
  setting.second_rate = path.second.rate;
  setting.is_straight = path.first.velocity.is_absent() || path.second.velocity.is_absent();
  setting.period = path.period;
  ColumnBetween positions;
  positions.match = std::move(match);
  positions.kind = ColumnBetween::Kind::position;
  positions.values_per_particle = 3;
  positions.first = path.first.position;
  positions.second = path.second.position;
  positions.fraction = static_cast<float>(fraction);
  positions.first_velocity = path.first.velocity;
  positions.second_velocity = path.second.velocity;
  positions.path = make_path_numbers(setting, fraction);
  positions.note = path.note;
  return positions;
}

FoundPeriod find_period(const BoxSides& box, const PathEnd& first, const PathEnd& second) {
  using namespace boost::qvm;
  FoundPeriod found;
  found.particles = (first.position.size() + second.position.size()) / 3;
  found.outside = found.particles;
  for (const double side_below : {0.0, 0.5}) {
    const PeriodicRange range = {-side_below * box.vector(), box};
    const std::uint64_t outside = count_outside(first, range) + count_outside(second, range);
    if (side_below == 0 || outside < found.outside) {
      found.range = range;
      found.outside = outside;
    }
    if (outside == 0) break;
  }
  return found;
}

// Blocks are added up in their order, so that the sum is the same on any number of cores.
std::optional<double> tangent_ratio(const TypePath& path, const IdMatch& match) {
  const std::size_t count = match.place_in_second.size();
  std::vector<Squares> blocks(ceil_divide(count, block_size));
  for_blocks(count, block_size, [&](std::size_t begin, std::size_t end) {
    Squares& sum = blocks[begin / block_size];
    for (std::size_t a = begin; a < end; ++a) {
      if (match.place_in_second[a] == IdMatch::nobody) continue;
      const Squares squares = squares_of(path, a, match.place_in_second[a]);
      if (!std::isfinite(squares.of_tangents) || !std::isfinite(squares.of_ways)) continue;
      sum.of_tangents += squares.of_tangents;
      sum.of_ways += squares.of_ways;
    }
  });
  Squares all;
  for (const Squares& block : blocks) {
    all.of_tangents += block.of_tangents;
    all.of_ways += block.of_ways;
  }
  if (!(all.of_tangents > 0) || !(all.of_ways > 0)) return std::nullopt;
  return std::sqrt(all.of_tangents / all.of_ways);
}

Column SequenceMember::read(int type, const std::string& field) const {
  const TypeField key = {type, require_field(info(), type, field).name};
  const std::lock_guard lock(mutex_);
  const auto found = columns_.find(key);
  if (found != columns_.end()) return found->second;
  return columns_[key] = DerivedSnapshot::read(type, field);
}

std::set<TypeField> SequenceMember::fields_read() const {
  const std::lock_guard lock(mutex_);
  std::set<TypeField> fields;
  for (const auto& [field, column] : columns_)
    fields.insert(field);
  return fields;
}

namespace {

std::vector<std::uint64_t> ids_of(const Snapshot& snapshot, int type) {
  if (snapshot.info().find_type(type) == nullptr) return {};
  return snapshot.read_ids(type);
}

std::string name_of(const SnapshotInfo& info) {
  return info.files.front().filename().string();
}

void check_velocities(const SnapshotInfo& info) {
  for (const ParticleTypeInfo& type : info.types) {
    const FieldInfo* const velocity = find_field(type, "velocity");
    if (velocity != nullptr && velocity->values_per_particle == 3) continue;
    throw UsageError(
        fmt::format("time.interpolation is \"hermite\", which needs velocities, but particles of "
                    "type {} in {} have none; set time.interpolation to \"linear\"",
                    type.type, info.files.front().string()));
  }
}

void note_strangers(int type, const IdMatch& match, SnapshotPair& pair) {
  const std::size_t vanishing = match.place_in_second.size() - match.in_common;
  const std::string names =
      fmt::format("from {} to {}", name_of(pair.first->info()), name_of(pair.second->info()));
  if (vanishing + match.appearing.size() > match.ambiguous) {
    pair.notes.push_back(fmt::format("{}, {} of type {} vanish and {} appear: they fade", names,
                                     counted(vanishing, "particle"), type, match.appearing.size()));
  }
  if (match.ambiguous > 0) {
    pair.notes.push_back(fmt::format(
        "{}, {} of type {} share their id with another, so that it is not known which is which: "
        "they fade instead of moving",
        names, counted(match.ambiguous, "particle"), type));
  }
}

// Wrong units make velocities wrong by powers of ten; snapshots that are too far apart, by
// less.
void check_tangents(int type, SnapshotPair& pair) {
  constexpr double impossible = 300, doubtful = 2;
  const TypePath& path = pair.path(type);
  const auto ratio = tangent_ratio(path, *pair.matches.at(type));
  if (!ratio) return;
  const SnapshotInfo& info = pair.first->info();
  if (*ratio > impossible || *ratio < 1 / impossible) {
    throw UsageError(fmt::format(
        "time.interpolation is \"hermite\", but from {} to {} particles of type {} move {:.2g} "
        "times as far as their velocities say; set time.hubble_rate (now {:.3g}), or "
        "time.interpolation to \"linear\"",
        info.files.front().string(), pair.second->info().files.front().string(), type, 1 / *ratio,
        info.cosmology ? info.cosmology->hubble_rate : 0));
  }
  if (*ratio < doubtful) return;
  pair.notes.push_back(fmt::format(
      "from {} to {}, particles of type {} move {:.2g} times less far than their velocities say: "
      "they turn in between, and \"hermite\" scatters them; use snapshots closer together",
      name_of(info), name_of(pair.second->info()), type, *ratio));
}

// What lies so far beside the box that it has not just left it.
std::string tell_of_outside(const FoundPeriod& found) {
  if (found.outside == 0) return {};
  const std::string what = fmt::format(
      "{} of {} particles of both snapshots lie farther outside of the periodic box of {} than a "
      "hundredth of its side",
      found.outside, found.particles, found.range.size.text());
  if (found.is_of_particles()) {
    return what + fmt::format(
                      ": they are drawn at their images within it, from {:g} to {:g} along x; if "
                      "they do not belong there, leave them out by select",
                      found.range.lower.a[0], found.range.lower.a[0] + found.range.size[0]);
  }
  return what +
         ": the box is not used, and what crosses its faces moves through all of it; put particles "
         "into the box, or set periodic.box to its true side";
}

}  // namespace

Column read_or_nothing(const SequenceMember& member, int type, const std::string& field) {
  return member.info().find_type(type) == nullptr ? Column() : member.read(type, field);
}

PathEnd SnapshotPair::path_end(const SequenceMember& member, int type, double rate) const {
  PathEnd end;
  end.position = read_or_nothing(member, type, "position");
  end.origin = member.position_origin();
  if (!motion) return end;
  end.velocity = read_or_nothing(member, type, "velocity");
  end.rate = rate * (motion->second_time - motion->first_time);
  return end;
}

const TypePath& SnapshotPair::path(int type) const {
  const std::lock_guard lock(mutex_);
  const auto found = paths_.find(type);
  if (found != paths_.end()) return found->second;
  TypePath path;
  path.first = path_end(*first, type, motion ? motion->first_rate : 0);
  path.second = path_end(*second, type, motion ? motion->second_rate : 0);
  if (box) {
    const FoundPeriod found = find_period(*box, path.first, path.second);
    if (found.is_of_particles()) path.period = found.range;
    path.note = tell_of_outside(found);
  }
  return paths_[type] = std::move(path);
}

void refuse_strangers(const SnapshotInfo& first, const SnapshotInfo& second) {
  throw DataError(
      fmt::format("{} and {}: no particle of the one is in the other, by its type and id; expected "
                  "snapshots of "
                  "the same run: check time.snapshots",
                  first.files.front().string(), second.files.front().string()));
}

std::shared_ptr<const SnapshotPair> make_pair(std::shared_ptr<const SequenceMember> first,
                                              std::shared_ptr<const SequenceMember> second,
                                              const SequenceSettings& settings,
                                              const std::optional<BoxSides>& box) {
  auto pair = std::make_shared<SnapshotPair>();
  pair->first = std::move(first);
  pair->second = std::move(second);
  const SnapshotInfo& before = pair->first->info();
  const SnapshotInfo& after = pair->second->info();
  pair->box = box;
  if (!box && before.box_size == after.box_size) pair->box = before.box_size;
  if (settings.interpolation == Interpolation::hermite) {
    check_velocities(before);
    check_velocities(after);
    pair->motion = find_motion(before, after, settings);
  }
  std::set<int> types;
  for (const SnapshotInfo* const info : {&before, &after}) {
    for (const ParticleTypeInfo& type : info->types)
      types.insert(type.type);
  }
  std::size_t in_common = 0;
  for (const int type : types) {
    auto match = std::make_shared<const IdMatch>(
        match_ids(ids_of(*pair->first, type), ids_of(*pair->second, type)));
    in_common += match->in_common;
    note_strangers(type, *match, *pair);
    pair->matches.emplace(type, std::move(match));
  }
  if (in_common == 0) refuse_strangers(before, after);
  for (const int type : types) {
    if (pair->motion) check_tangents(type, *pair);
  }
  return pair;
}

}  // namespace splotchcl
