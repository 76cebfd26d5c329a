#pragma once

#include <list>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "load/component_fields.h"
#include "load/missing_sizes.h"
#include "splotchcl/scene.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// The components of a scene with their snapshots. Refuses whatever can be refused before any
// particle is read. Refers to the scene, the snapshot and the notes.
class OpenComponents {
 public:
  // Throws UsageError, or DataError for snapshots of components that cannot be opened.
  // `periodic_box` is the box that particles are wrapped into.
  OpenComponents(const Scene& scene, const Snapshot& snapshot, const MissingSizes& sizes,
                 std::vector<std::string>& notes,
                 const std::optional<BoxSides>& periodic_box = std::nullopt);

  // A frame is loaded from now on: what the snapshots remember and frames no longer ask for is
  // forgotten.
  void begin_load();

  // In the order of the scene's components.
  std::list<ComponentFields>& fields() { return fields_; }

 private:
  std::vector<std::shared_ptr<const Snapshot>> companions_;
  std::set<const Snapshot*> sources_;
  std::list<ComponentFields> fields_;
};

}  // namespace splotchcl
