#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "splotchcl/frame.h"
#include "splotchcl/frame_drawer.h"
#include "splotchcl/open_scene.h"
#include "splotchcl/snapshot_source.h"
#include "tree/tree_preview.h"
#include "view/frame_scheduler.h"
#include "view/tree_maker.h"

namespace splotchcl::view {

// A part of a frame's particles that has the light of all: each stands for as many as were left
// out. Which these are depends on their number alone, so that a picture that is turned does not
// flicker.
class FrameSampler {
 public:
  // At most about `particles` of all components together; 0: all. What was gathered for one of the
  // last frames is used again where the frame has the same columns.
  Frame sample(const Frame& frame, std::uint64_t particles);

 private:
  struct Kept {
    Particles source, sample;
    std::uint64_t last_frame = 0;  // that used it
  };
  const Particles& sample_component(std::size_t component, const Particles& all, std::size_t count);
  void forget_unused();

  std::uint64_t frame_ = 0;
  std::map<std::pair<std::size_t, std::size_t>, Kept> kept_;  // by component and count
};

// A picture as the page gets it.
struct ViewPicture {
  bool is_jpeg = false;             // else PNG, with the bits that render writes
  std::vector<unsigned char> file;  // the whole of it
  // The scene's, with the exposure and white that were found where it leaves them open.
  std::optional<FinishSettings> finish;
  std::vector<std::string> notes;
  double seconds = 0;  // to load, to draw and to store it
};

// Thrown where `go_on` has said that a picture is not wanted any more.
struct DrawingCancelled {};

// Draws what pages show of one opened scene. Reads a snapshot's columns once. Not for use from
// several threads at once.
class ViewDrawer {
 public:
  struct Options {
    std::string device;  // as FrameDrawerOptions has it
    CompositeShape shape = CompositeShape::automatic;
    // Asked from part to part of a picture; false ends the drawing with DrawingCancelled.
    std::function<bool()> go_on;
  };

  // Decides what the scene leaves to the data; `notes` takes what the user should know. Throws as
  // decide does, and DeviceError.
  ViewDrawer(SceneWithSnapshot source, const Options& options, std::vector<std::string>& notes);

  // The scene as it was opened, with every number decided but exposure and white.
  const Scene& opened() const { return opened_; }
  // As which it began where a snapshot was opened; else null.
  const Scene* suggested() const { return suggested_ ? &*suggested_ : nullptr; }
  // What the scene draws: of a sequence the moment that it says.
  std::shared_ptr<const Snapshot> snapshot_of(const Scene& scene) const;
  std::uint64_t particles() const { return particles_; }
  // A component for particles that the opened scene may not show, as it is suggested for them, with
  // every number decided. Throws UsageError for a type that there is none of.
  const Component& component_for(const std::string& type);
  // The snapshot as a look shows it (docs/looks.md), with every number decided. Throws UsageError
  // for a look that there is none of.
  Scene with_look(const std::string& look) const;

  // A scene with numbers found anew where a page left them open.
  Scene decide(const Scene& scene) const;

  ViewPicture preview(const Scene& scene, const PreviewLevel& level);
  ViewPicture exact(const Scene& scene);
  // As splotchcl render draws it.
  DrawnFrame draw(const Scene& scene, PictureLight light = PictureLight::shown);

  // All particles of the scene, and at most about so many of them.
  Frame load(const Scene& scene) const;
  Frame sample(const Scene& scene, std::uint64_t particles);

 private:
  Scene opened_;
  std::optional<Scene> suggested_;
  mutable SnapshotSource source_;                    // of a sequence
  mutable std::shared_ptr<const Snapshot> moment_;   // of the sequence that was asked for last
  std::shared_ptr<const Snapshot> snapshot_;         // that was opened, with its columns
  std::map<std::string, Component> components_for_;  // by their types
  FrameSampler sampler_;
  TreePreview tree_preview_;
  FrameDrawer drawer_;
  std::uint64_t particles_ = 0;
  std::optional<TreeMaker> tree_maker_;  // reads the snapshot before anything else is drawn
};

}  // namespace splotchcl::view
