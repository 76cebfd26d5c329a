#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "splotchcl/read_settings.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// A part of a snapshot's particles: every N-th of each type, or at most so many, one chosen at
// random from each of as many equal runs of the file. The same settings choose the same
// particles. ParticleTypeInfo::particles_per_drawn says how many each of a type stands for: numbers
// are rounded, so that it is another one for types of few particles.
class SubsetSnapshot : public Snapshot {
 public:
  SubsetSnapshot(std::shared_ptr<const Snapshot> whole, const ReadSettings& read);

  const SnapshotInfo& info() const override { return info_; }
  Column read(int type, const std::string& field) const override;
  std::vector<std::uint64_t> read_ids(int type) const override;
  std::vector<std::uint64_t> read_integers(int type, const std::string& field) const override;
  std::uint64_t place_in_file(int type, std::uint64_t i) const override;
  Vec3 position_origin() const override { return whole_->position_origin(); }

 private:
  // Where the i-th particle of a type is in the whole.
  struct Places {
    std::uint64_t all = 0, some = 0;
    std::uint64_t every = 0;  // 0: at random
    std::uint64_t hash = 0;   // of the seed and the type
    std::uint64_t operator()(std::uint64_t i) const;
  };

  std::uint64_t count_of(std::uint64_t count, std::uint64_t total) const;
  Places places_of(int type) const;
  std::vector<std::uint64_t> chosen_of(int type, const std::vector<std::uint64_t>& all) const;

  std::shared_ptr<const Snapshot> whole_;
  ReadSettings read_;
  SnapshotInfo info_;
};

// The particles of another snapshot, but for what a derived class says of them.
class DerivedSnapshot : public Snapshot {
 public:
  const SnapshotInfo& info() const override { return original_->info(); }
  Column read(int type, const std::string& field) const override {
    return original_->read(type, field);
  }
  std::vector<std::uint64_t> read_ids(int type) const override { return original_->read_ids(type); }
  std::vector<std::uint64_t> read_integers(int type, const std::string& field) const override {
    return original_->read_integers(type, field);
  }
  std::uint64_t place_in_file(int type, std::uint64_t i) const override {
    return original_->place_in_file(type, i);
  }
  Vec3 position_origin() const override { return original_->position_origin(); }

 protected:
  explicit DerivedSnapshot(std::shared_ptr<const Snapshot> original)
      : original_(std::move(original)) {}

 private:
  std::shared_ptr<const Snapshot> original_;
};

// A snapshot that remembers every column it was once asked for, so that load_frame may be
// called for each frame of a film and reads only once (what it makes of them is in memory()).
// Identifiers and whole numbers are not remembered. Not for use from several threads at once.
class CachedSnapshot : public DerivedSnapshot {
 public:
  explicit CachedSnapshot(std::shared_ptr<const Snapshot> snapshot)
      : DerivedSnapshot(std::move(snapshot)) {}
  Column read(int type, const std::string& field) const override;

 private:
  mutable std::map<std::pair<int, std::string>, Column> read_;
};

// The snapshot with units that its file does not say, or says wrongly: FIELD=UNIT, by any name of
// the field, or the name of a system for all that it does not say. Numbers stay, but smoothing
// lengths are then in the unit of positions. Throws UsageError for fields that no type has, and for
// what is no unit.
std::unique_ptr<Snapshot> with_named_units(std::unique_ptr<Snapshot> snapshot,
                                           const std::vector<std::string>& units);

}  // namespace splotchcl
