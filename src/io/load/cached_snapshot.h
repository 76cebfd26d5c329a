#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "splotchcl/snapshot.h"

namespace splotchcl {

// A snapshot that remembers every column it was once asked for, so that load_frame may be
// called for each frame of a film and reads, and finds smoothing lengths, only once. Not for
// use from several threads at once.
class CachedSnapshot : public Snapshot {
 public:
  explicit CachedSnapshot(std::shared_ptr<const Snapshot> snapshot);

  const SnapshotInfo& info() const override;
  Column read(int type, const std::string& field) const override;
  std::vector<std::uint64_t> read_ids(int type) const override;  // not remembered
  Column derived(int type, const std::string& name,
                 const std::function<Column()>& make) const override;
  Vec3 position_origin() const override;

 private:
  using Columns = std::map<std::pair<int, std::string>, Column>;

  std::shared_ptr<const Snapshot> snapshot_;
  mutable Columns read_, derived_;
};

}  // namespace splotchcl
