#include "sequence/film_snapshots.h"

#include "splotchcl/scene.h"

namespace splotchcl {

std::shared_ptr<const Snapshot> FilmSnapshots::at(const Scene& scene) {
  std::shared_ptr<const Snapshot> snapshot = source_.at(scene);
  if (scene.time.is_set()) return snapshot;
  if (single_ != snapshot) {
    single_ = snapshot;
    cached_ = std::make_shared<CachedSnapshot>(snapshot);
  }
  return cached_;
}

}  // namespace splotchcl
