#pragma once

#include <list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "load/components.h"
#include "splotchcl/load.h"

namespace splotchcl {

// Decides and loads one frame of a scene. What both steps read is read once. Refers to the scene,
// the snapshot and the notes.
class FrameLoader {
 public:
  // Refuses whatever can be refused before particles are read.
  FrameLoader(const Scene& scene, const Snapshot& snapshot, std::vector<std::string>& notes,
              const LoadProgress& progress);

  // Before anything is read for a frame: what earlier frames have left and this one does not ask
  // for is forgotten. Deciding alone keeps it.
  void begin_load() { components_->begin_load(); }
  Camera decide_camera() const;
  DecidedScene decide();
  Frame load(const DecidedScene& decided);
  // Before particles, which may take long: it may be refused.
  void read_background();

 private:
  // A component, and its particles once they have been read.
  struct Part {
    ComponentReader reader;
    std::optional<DrawnComponent> drawn;
  };

  Frame frame_of(const Camera& camera) const;  // without components
  DecidedComponent decide_component(Part& part, const Camera& camera, const Frame& frame);
  void decide_reference(Part& part, const Camera& camera, const Frame& frame,
                        DecidedComponent& decided);
  const DrawnComponent& read(Part& part, WeightModel weight, const Vec3& look_at);

  const Scene& scene_;
  const Snapshot& snapshot_;
  std::vector<std::string>& notes_;
  std::optional<BoxSides> periodic_box_;  // unset: particles stay where they are
  std::optional<OpenComponents> components_;
  std::list<Part> parts_;  // in the order of the scene's components
  std::shared_ptr<const Image> background_;
};

}  // namespace splotchcl
