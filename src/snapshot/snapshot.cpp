#include "splotchcl/snapshot.h"

#include <fmt/format.h>

#include <algorithm>

#include "snapshot/load_memory.h"
#include "splotchcl/error.h"

namespace splotchcl {

const ParticleTypeInfo* SnapshotInfo::find_type(int type) const {
  const auto found = std::find_if(types.begin(), types.end(),
                                  [type](const ParticleTypeInfo& t) { return t.type == type; });
  return found == types.end() ? nullptr : &*found;
}

std::vector<std::uint64_t> Snapshot::read_ids(int type) const {
  throw DataError(
      fmt::format("{}: its format ({}) has no ids for particles of type {}; expected ids, by which "
                  "particles of "
                  "different snapshots are matched: use a snapshot with ids",
                  info().files.front().string(), info().format, type));
}

LoadMemory& Snapshot::memory() const {
  if (!memory_) memory_ = std::make_shared<LoadMemory>();
  return *memory_;
}

void Snapshot::share_lasting_memory_of(const Snapshot& other) {
  memory().share_with(other.memory());
}

}  // namespace splotchcl
