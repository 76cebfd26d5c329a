#include "snapshot/load_memory.h"

#include "splotchcl/snapshot.h"

namespace splotchcl {

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
