#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>

#include "sequence/type_path.h"

namespace splotchcl {

// Two snapshots at a moment between them. Has the fields that both have.
class InterpolatedSnapshot : public Snapshot {
 public:
  // 0 < fraction < 1.
  InterpolatedSnapshot(std::shared_ptr<const SnapshotPair> pair, double fraction);

  const SnapshotInfo& info() const override { return info_; }
  Column read(int type, const std::string& field) const override;
  std::vector<std::uint64_t> read_ids(int type) const override;
  // Those of the first, as of ids; there is nothing between two. Numbers of haloes and places in a
  // file mean nothing here: they throw UsageError.
  std::vector<std::uint64_t> read_integers(int type, const std::string& field) const override;
  std::uint64_t place_in_file(int type, std::uint64_t i) const override;
  Vec3 position_origin() const override { return pair_->first->position_origin(); }

 private:
  std::vector<std::uint64_t> whole_numbers(
      int type, const std::function<std::vector<std::uint64_t>(const Snapshot&)>& read) const;
  [[noreturn]] void refuse_haloes() const;
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
