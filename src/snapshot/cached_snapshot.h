#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "splotchcl/snapshot.h"

namespace splotchcl {

// A snapshot that remembers every column it was once asked for, so that load_frame may be
// called for each frame of a film and reads only once (what it makes of them is in memory()).
// Not for use from several threads at once.
class CachedSnapshot : public Snapshot {
 public:
  explicit CachedSnapshot(std::shared_ptr<const Snapshot> snapshot);

  const SnapshotInfo& info() const override;
  Column read(int type, const std::string& field) const override;
  std::vector<std::uint64_t> read_ids(int type) const override;  // not remembered
  std::vector<std::uint64_t> read_integers(int type, const std::string& field) const override;
  std::uint64_t place_in_file(int type, std::uint64_t i) const override;
  Vec3 position_origin() const override;

 private:
  using Columns = std::map<std::pair<int, std::string>, Column>;

  std::shared_ptr<const Snapshot> snapshot_;
  mutable Columns read_;
};

}  // namespace splotchcl
