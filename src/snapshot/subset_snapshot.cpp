#include "snapshot/subset_snapshot.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "scene/ceil_divide.h"
#include "scene/hash.h"
#include "scene/streamed_column.h"

namespace splotchcl {
namespace {

// a * b / c without overflow, rounded down.
std::uint64_t scale(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
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

// Where the i-th of the type is in the whole.
std::uint64_t SubsetSnapshot::place(int type, std::uint64_t i) const {
  if (!read_.max_particles) return i * static_cast<std::uint64_t>(read_.every);
  const std::uint64_t all = whole_->info().find_type(type)->count;
  const std::uint64_t some = info_.find_type(type)->count;
  const std::uint64_t first = scale(i, all, some), end = scale(i + 1, all, some);
  const auto seed = static_cast<std::uint64_t>(read_.seed);
  return first +
         hash_of(hash_of(hash_of(seed) + static_cast<std::uint64_t>(type)) + i) % (end - first);
}

Column SubsetSnapshot::read(int type, const std::string& field) const {
  const Column all = whole_->read(type, field);
  const ParticleTypeInfo* const chosen = info_.find_type(type);
  if (!all.is_array() || chosen->count == whole_->info().find_type(type)->count) return all;
  const std::size_t width = all.size() / whole_->info().find_type(type)->count;
  return gather_in_order(all, width, chosen->count, [&](std::size_t i) { return place(type, i); });
}

std::vector<std::uint64_t> SubsetSnapshot::chosen_of(int type,
                                                     const std::vector<std::uint64_t>& all) const {
  std::vector<std::uint64_t> chosen;
  const std::uint64_t count = info_.find_type(type)->count;
  chosen.reserve(count);
  for (std::uint64_t i = 0; i < count; ++i)
    chosen.push_back(all[place(type, i)]);
  return chosen;
}

std::vector<std::uint64_t> SubsetSnapshot::read_ids(int type) const {
  return chosen_of(type, whole_->read_ids(type));
}

std::vector<std::uint64_t> SubsetSnapshot::read_integers(int type, const std::string& field) const {
  return chosen_of(type, whole_->read_integers(type, field));
}

std::uint64_t SubsetSnapshot::place_in_file(int type, std::uint64_t i) const {
  return whole_->place_in_file(type, place(type, i));
}

}  // namespace splotchcl
