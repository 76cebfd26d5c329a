#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

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

}  // namespace splotchcl
