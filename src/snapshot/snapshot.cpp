#include "splotchcl/snapshot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "snapshot/field_names.h"
#include "snapshot/load_memory.h"
#include "splotchcl/error.h"

namespace splotchcl {

const ParticleTypeInfo* SnapshotInfo::find_type(int type) const {
  const auto found = std::find_if(types.begin(), types.end(),
                                  [type](const ParticleTypeInfo& t) { return t.type == type; });
  return found == types.end() ? nullptr : &*found;
}

bool SnapshotInfo::is_whole() const {
  return std::all_of(types.begin(), types.end(),
                     [](const ParticleTypeInfo& type) { return type.particles_per_drawn == 1; });
}

std::vector<std::uint64_t> Snapshot::read_ids(int type) const {
  return read_integers(type, require_ids(info(), type).name);
}

// For formats that keep all numbers as floats: a float holds each whole number to 2^24.
std::vector<std::uint64_t> Snapshot::read_integers(int type, const std::string& field) const {
  constexpr float largest = 16777216.0F;
  const Column values = read(type, field);
  std::vector<std::uint64_t> numbers;
  for (std::size_t i = 0; i < info().find_type(type)->count; ++i) {
    const float value = values[i];
    if (!(std::abs(value) <= largest) || value != std::floor(value)) {
      throw DataError(fmt::format("{}: {} of type {} holds {}, expected whole numbers up to 2^24",
                                  info().files.front().string(), field, type, value));
    }
    numbers.push_back(static_cast<std::uint64_t>(static_cast<std::int64_t>(value)));
  }
  return numbers;
}

std::uint64_t Snapshot::place_in_file(int /*type*/, std::uint64_t i) const {
  return i;
}

LoadMemory& Snapshot::memory() const {
  if (!memory_) memory_ = std::make_shared<LoadMemory>();
  return *memory_;
}

void Snapshot::share_lasting_memory_of(const Snapshot& other) {
  memory().share_with(other.memory());
}

std::shared_ptr<const Snapshot> LoadMemory::companion(const std::string& path,
                                                      const OpenCompanion& open) {
  std::shared_ptr<const Snapshot>& snapshot = shared_->companions[path];
  if (!snapshot) snapshot = open(path);
  return snapshot;
}

void LoadMemory::begin_load() {
  own_.begin_load();
  shared_->values.begin_load();
}

void LoadMemory::Values::begin_load() {
  constexpr std::uint64_t kept_loads = 2;
  ++load_;
  for (auto value = values_.begin(); value != values_.end();) {
    value = value->second.last_load + kept_loads < load_ ? values_.erase(value) : std::next(value);
  }
}

}  // namespace splotchcl
