#include "snapshot/cached_snapshot.h"

#include "snapshot/field_names.h"

namespace splotchcl {

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
