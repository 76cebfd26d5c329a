#include "sequence/snapshot_pair.h"

#include <fmt/format.h>

#include <set>

#include "snapshot/field_names.h"
#include "splotchcl/error.h"

namespace splotchcl {

Column SequenceMember::read(int type, const std::string& field) const {
  const TypeField key = {type, require_field(info(), type, field).name};
  const std::lock_guard lock(mutex_);
  const auto found = columns_.find(key);
  if (found != columns_.end()) return found->second;
  return columns_[key] = snapshot_->read(type, field);
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
    pair.notes.push_back(fmt::format("{}, {} particles of type {} vanish and {} appear: they fade",
                                     names, vanishing, type, match.appearing.size()));
  }
  if (match.ambiguous > 0) {
    pair.notes.push_back(fmt::format(
        "{}, {} particles of type {} share their id with another, so that it is not known which is "
        "which: they fade instead of moving",
        names, match.ambiguous, type));
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
      "{} of {} particles of both snapshots lie farther outside of the header's box of {:g} than a "
      "hundredth of its side",
      found.outside, found.particles, found.range.size);
  if (found.is_of_particles()) {
    return what + fmt::format(
                      ": they are drawn at their images within it, from {:g} to {:g}; if they do "
                      "not belong there, leave them out by select",
                      found.range.lower, found.range.lower + found.range.size);
  }
  return what +
         ": the box is not used, and what crosses its faces moves through all of it; put particles "
         "into the box, or write its true side";
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
  // Paths have one period for all axes.
  const std::optional<BoxSides>& box = first->info().box_size;
  if (box && box->is_cube() && box == second->info().box_size) {
    const FoundPeriod found = find_period(box->longest(), path.first, path.second);
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
                                              const SequenceSettings& settings) {
  auto pair = std::make_shared<SnapshotPair>();
  pair->first = std::move(first);
  pair->second = std::move(second);
  const SnapshotInfo& before = pair->first->info();
  const SnapshotInfo& after = pair->second->info();
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
