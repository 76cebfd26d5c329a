#pragma once

#include <map>
#include <memory>
#include <mutex>

#include "sequence/interpolate.h"
#include "sequence/snapshot_pair.h"

namespace splotchcl {

// Two snapshots at a moment between them. Has the fields that both have.
class InterpolatedSnapshot : public Snapshot {
 public:
  // 0 < fraction < 1.
  InterpolatedSnapshot(std::shared_ptr<const SnapshotPair> pair, double fraction);

  const SnapshotInfo& info() const override { return info_; }
  Column read(int type, const std::string& field) const override;
  std::vector<std::uint64_t> read_ids(int type) const override;
  Vec3 position_origin() const override { return pair_->first->position_origin(); }

 private:
  void describe_moment();
  void describe_type(int type, const IdMatch& match);
  Column interpolate(int type, const FieldInfo& field) const;

  std::shared_ptr<const SnapshotPair> pair_;
  double fraction_;
  SnapshotInfo info_;
  mutable std::mutex mutex_;
  mutable std::map<TypeField, Column> columns_;
};

}  // namespace splotchcl
