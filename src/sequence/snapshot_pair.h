#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "between/id_match.h"
#include "sequence/type_path.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// A field of a particle type.
using TypeField = std::pair<int, std::string>;

// One snapshot of a sequence: its columns are read once. May be used by several threads.
class SequenceMember : public Snapshot {
 public:
  explicit SequenceMember(std::unique_ptr<Snapshot> snapshot) : snapshot_(std::move(snapshot)) {}

  const SnapshotInfo& info() const override { return snapshot_->info(); }
  Column read(int type, const std::string& field) const override;
  std::vector<std::uint64_t> read_ids(int type) const override { return snapshot_->read_ids(type); }
  std::vector<std::uint64_t> read_integers(int type, const std::string& field) const override {
    return snapshot_->read_integers(type, field);
  }
  std::uint64_t place_in_file(int type, std::uint64_t i) const override {
    return snapshot_->place_in_file(type, i);
  }
  Vec3 position_origin() const override { return snapshot_->position_origin(); }

  std::set<TypeField> fields_read() const;  // by canonical names

 private:
  std::unique_ptr<Snapshot> snapshot_;
  mutable std::mutex mutex_;
  mutable std::map<TypeField, Column> columns_;
};

// Two snapshots that follow each other, with their particles matched.
class SnapshotPair {
 public:
  // Columns of a type that a snapshot does not have are absent.
  const TypePath& path(int type) const;  // read at the first call

  std::shared_ptr<const SequenceMember> first, second;
  std::map<int, std::shared_ptr<const IdMatch>> matches;  // of every type that either has
  std::optional<Motion> motion;                           // with hermite
  std::vector<std::string> notes;

 private:
  PathEnd path_end(const SequenceMember& member, int type, double rate) const;

  mutable std::mutex mutex_;
  mutable std::map<int, TypePath> paths_;
};

// A column of a member, absent where the member has nothing of the type.
Column read_or_nothing(const SequenceMember& member, int type, const std::string& field);

// Matches the particles of all types. Throws DataError when the two have none in common or no
// ids, UsageError when there are no velocities for hermite.
std::shared_ptr<const SnapshotPair> make_pair(std::shared_ptr<const SequenceMember> first,
                                              std::shared_ptr<const SequenceMember> second,
                                              const SequenceSettings& settings);

// For snapshots without a particle in common.
[[noreturn]] void refuse_strangers(const SnapshotInfo& first, const SnapshotInfo& second);

}  // namespace splotchcl
