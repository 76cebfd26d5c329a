#include "snapshot/derived_snapshots.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "scene/ceil_divide.h"
#include "scene/hash.h"
#include "scene/particle_columns.h"
#include "snapshot/field_names.h"

namespace splotchcl {
namespace {

// a * b / c without overflow, rounded down.
std::uint64_t scale(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
  // A division of 64 bits is one instruction, where it is enough.
  if (std::max(a, b) <= UINT32_MAX) return a * b / c;
  __extension__ using Wide = unsigned __int128;
  return static_cast<std::uint64_t>(static_cast<Wide>(a) * b / c);
}

std::uint64_t total_count(const SnapshotInfo& info) {
  std::uint64_t total = 0;
  for (const ParticleTypeInfo& type : info.types)
    total += type.count;
  return total;
}

// "3", or "3.33333 of type 0 and 2.5 of type 4".
std::string tell_what_each_stands_for(const SnapshotInfo& info) {
  const double first = info.types.front().particles_per_drawn;
  std::vector<std::string> of_types;
  bool is_same = true;
  for (const ParticleTypeInfo& type : info.types) {
    is_same = is_same && type.particles_per_drawn == first;
    of_types.push_back(fmt::format("{:.6g} of type {}", type.particles_per_drawn, type.type));
  }
  return is_same ? fmt::format("{:.6g}", first) : fmt::format("{}", fmt::join(of_types, ", "));
}

}  // namespace

SubsetSnapshot::SubsetSnapshot(std::shared_ptr<const Snapshot> whole, const ReadSettings& read)
    : whole_(std::move(whole)), read_(read), info_(whole_->info()) {
  const std::uint64_t total = total_count(info_);
  for (ParticleTypeInfo& type : info_.types) {
    const std::uint64_t all = type.count;
    type.count = count_of(all, total);
    if (all > 0) {
      type.particles_per_drawn *= static_cast<double>(all) / static_cast<double>(type.count);
    }
  }
  const std::uint64_t drawn = total_count(info_);
  if (drawn < total) {
    info_.notes.push_back(fmt::format("only {} of {} particles are read; each stands for {}", drawn,
                                      total, tell_what_each_stands_for(info_)));
  }
}

std::uint64_t SubsetSnapshot::count_of(std::uint64_t count, std::uint64_t total) const {
  if (!read_.max_particles) {
    return ceil_divide(count, static_cast<std::uint64_t>(read_.every));
  }
  const auto most = static_cast<std::uint64_t>(*read_.max_particles);
  if (total <= most) return count;
  return std::max<std::uint64_t>(1, scale(count, most, total));
}

SubsetSnapshot::Places SubsetSnapshot::places_of(int type) const {
  Places places;
  places.all = whole_->info().find_type(type)->count;
  places.some = info_.find_type(type)->count;
  if (!read_.max_particles) {
    places.every = static_cast<std::uint64_t>(read_.every);
  } else {
    const auto seed = static_cast<std::uint64_t>(read_.seed);
    places.hash = hash_of(hash_of(seed) + static_cast<std::uint64_t>(type));
  }
  return places;
}

std::uint64_t SubsetSnapshot::Places::operator()(std::uint64_t i) const {
  if (every > 0) return i * every;
  const std::uint64_t first = scale(i, all, some), end = scale(i + 1, all, some);
  return first + hash_of(hash + i) % (end - first);
}

Column SubsetSnapshot::read(int type, const std::string& field) const {
  const Column all = whole_->read(type, field);
  const Places places = places_of(type);
  if (!all.is_array() || places.some == places.all) return all;
  return gather_in_order(all, all.size() / places.all, places.some, places);
}

std::vector<std::uint64_t> SubsetSnapshot::chosen_of(int type,
                                                     const std::vector<std::uint64_t>& all) const {
  std::vector<std::uint64_t> chosen;
  const Places places = places_of(type);
  chosen.reserve(places.some);
  for (std::uint64_t i = 0; i < places.some; ++i)
    chosen.push_back(all[places(i)]);
  return chosen;
}

std::vector<std::uint64_t> SubsetSnapshot::read_ids(int type) const {
  return chosen_of(type, whole_->read_ids(type));
}

std::vector<std::uint64_t> SubsetSnapshot::read_integers(int type, const std::string& field) const {
  return chosen_of(type, whole_->read_integers(type, field));
}

std::uint64_t SubsetSnapshot::place_in_file(int type, std::uint64_t i) const {
  return whole_->place_in_file(type, places_of(type)(i));
}

CachedSnapshot::CachedSnapshot(std::shared_ptr<const Snapshot> snapshot)
    : snapshot_(std::move(snapshot)) {}

const SnapshotInfo& CachedSnapshot::info() const {
  return snapshot_->info();
}

Column CachedSnapshot::read(int type, const std::string& field) const {
  // By the field's own name: a file's label for it finds the same column.
  const std::pair key(type, require_field(info(), type, field).name);
  const auto found = read_.find(key);
  if (found != read_.end()) return found->second;
  return read_[key] = snapshot_->read(type, field);
}

std::vector<std::uint64_t> CachedSnapshot::read_ids(int type) const {
  return snapshot_->read_ids(type);
}

std::vector<std::uint64_t> CachedSnapshot::read_integers(int type, const std::string& field) const {
  return snapshot_->read_integers(type, field);
}

std::uint64_t CachedSnapshot::place_in_file(int type, std::uint64_t i) const {
  return snapshot_->place_in_file(type, i);
}

Vec3 CachedSnapshot::position_origin() const {
  return snapshot_->position_origin();
}

}  // namespace splotchcl
