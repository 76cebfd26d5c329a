#include "io/load/load_memory.h"

#include "splotchcl/snapshot.h"

namespace splotchcl {

std::shared_ptr<const Snapshot> LoadMemory::companion(const std::string& path) {
  std::shared_ptr<const Snapshot>& snapshot = shared_->companions[path];
  if (!snapshot) snapshot = open_snapshot(path);
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

LoadMemory& Snapshot::memory() const {
  if (!memory_) memory_ = std::make_shared<LoadMemory>();
  return *memory_;
}

void Snapshot::share_lasting_memory_of(const Snapshot& other) {
  memory().share_with(other.memory());
}

}  // namespace splotchcl
