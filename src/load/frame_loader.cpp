#include "load/frame_loader.h"

#include <fmt/format.h>

#include <utility>

#include "finish/color_bar.h"
#include "finish/finish_picture.h"
#include "image/background_image.h"
#include "load/check_particles.h"
#include "load/choose_palette.h"
#include "load/decide_map.h"
#include "load/passes.h"
#include "load/periodic_wrap.h"
#include "load/rounded_positions.h"
#include "load/suggest_scene_camera.h"
#include "scene/memory_advice.h"
#include "scene/reference_column.h"
#include "snapshot/load_memory.h"
#include "splotchcl/error.h"
#include "splotchcl/plan.h"

namespace splotchcl {
namespace {

// Those that lie where the scene's snapshot has them.
std::vector<int> types_in_place(const Scene& scene) {
  std::vector<int> types;
  for (const Component& component : scene.components) {
    if (!component.snapshot.empty() || component.placement.moves()) continue;
    types.insert(types.end(), component.types.begin(), component.types.end());
  }
  return types;
}

Camera choose_camera(const Scene& scene, const Snapshot& snapshot) {
  if (scene.camera) return *scene.camera;
  const std::vector<int> types = types_in_place(scene);
  if (types.empty()) {
    throw UsageError(
        "the scene has no camera and every component is placed elsewhere than its snapshot has "
        "it, expected a camera; add a [camera]");
  }
  return suggest_camera(suggest_target(snapshot, types, scene.image.width, scene.image.height));
}

// Read once for all frames of a film.
std::shared_ptr<const Image> background_image(const ImageSettings& image,
                                              const Snapshot& snapshot) {
  if (image.background_image.empty()) return nullptr;
  const std::string key = fmt::format("background {} {}x{} {}", image.background_image, image.width,
                                      image.height, image.gamma);
  return snapshot.memory().get_for_all_times<std::shared_ptr<const Image>>(key, [&image] {
    return load_background_image(image.background_image, image.width, image.height, image.gamma);
  });
}

// Nothing that is drawn errs by less.
void note_small_tolerance(double tolerance, std::vector<std::string>& notes) {
  if (tolerance == 0 || tolerance >= extended_tolerance) return;
  notes.push_back(fmt::format(
      "tolerance: found {:g}, which is drawn as 0: as exact as possible, to {:g}; expected 0 or "
      "at least that",
      tolerance, extended_tolerance));
}

}  // namespace

FrameLoader::FrameLoader(const Scene& scene, const Snapshot& snapshot,
                         std::vector<std::string>& notes, const LoadProgress& progress)
    : scene_(scene), snapshot_(snapshot), notes_(notes) {
  if (scene.components.empty()) {
    throw UsageError("the scene has no component, expected at least one; add a [[component]]");
  }
  check_finish(scene, snapshot.info());
  note_small_tolerance(scene.tolerance, notes);
  if (scene.periodic.wrap) periodic_box_ = periodic_box(scene.periodic, snapshot.info());
  components_.emplace(scene, snapshot, missing_sizes(scene, progress), notes, periodic_box_);
  auto fields = components_->fields().begin();
  for (const Component& component : scene.components)
    parts_.push_back({ComponentReader(component, scene.sort, *fields++), std::nullopt});
}

void FrameLoader::read_background() {
  if (!background_) background_ = background_image(scene_.image, snapshot_);
}

Camera FrameLoader::decide_camera() const {
  return choose_camera(scene_, snapshot_);
}

Frame FrameLoader::frame_of(const Camera& camera) const {
  Frame frame;
  frame.width = scene_.image.width;
  frame.height = scene_.image.height;
  frame.crop = {0, 0, frame.width, frame.height};
  frame.camera = make_camera_frame(camera, frame.width, frame.height);
  if (scene_.image.convention == PixelConvention::original) {
    frame.camera = in_original_convention(frame.camera);
  }
  frame.projection = camera.projection;
  frame.near_limit = camera.near_limit;
  frame.far_limit = camera.far_limit;
  frame.through_clouds = camera.through_clouds;
  frame.background = scene_.image.background;
  frame.kernel = scene_.kernel;
  frame.sort = scene_.sort;
  frame.tolerance = scene_.tolerance;
  return frame;
}

const DrawnComponent& FrameLoader::read(Part& part, WeightModel weight, const Vec3& look_at) {
  if (part.drawn) return *part.drawn;
  DrawnComponent drawn = part.reader.drawn(weight);
  if (periodic_box_ && is_in_the_box(part.reader.component())) {
    wrap_around(look_at, *periodic_box_, drawn.particles, has_shared_passes(snapshot_));
  }
  if (drawn.particles.boxes) {
    for (const Column* const column : drawn.particles.columns())
      expect_few_values(*column);
  }
  const ComponentFields& fields = part.reader.fields();
  check_particles(drawn, fields.snapshot_info().files.front().string(), fields.pass());
  return part.drawn.emplace(std::move(drawn));
}

// After all else is decided: the reference follows from what the camera sees.
void FrameLoader::decide_reference(Part& part, const Camera& camera, const Frame& frame,
                                   DecidedComponent& decided) {
  const Component& component = part.reader.component();
  if (component.reference_column) {
    // The reference is that of all particles; those that are drawn stand for the others.
    decided.reference_column = *component.reference_column / decided.particles_per_drawn;
    return;
  }
  DrawnComponent drawn = read(part, decided.weight, camera.look_at);
  drawn.color = decided.color;
  drawn.intensity = decided.intensity;
  const std::optional<double> reference =
      find_reference_column(drawn, frame, part.reader.fields().pass());
  if (!reference && drawn.particles.count > 0) {
    notes_.push_back(
        fmt::format("component {}: the camera sees none of its particles; check camera.position, "
                    "camera.look_at and the near and far limits",
                    drawn.name));
  }
  decided.is_seen = reference.has_value();
  decided.reference_column = reference.value_or(1);
}

DecidedComponent FrameLoader::decide_component(Part& part, const Camera& camera,
                                               const Frame& frame) {
  ComponentReader& reader = part.reader;
  const Component& component = reader.component();
  DecidedComponent decided;
  decided.weight = reader.weight();
  decided.particles_per_drawn = reader.fields().particles_per_drawn();
  // The reference needs all that ranges do.
  if (!component.reference_column) read(part, decided.weight, camera.look_at);
  decided.color = decide_map(
      component.color, [&reader] { return reader.color(); }, reader.fields(), "color");
  decided.intensity = decide_map(
      component.intensity, [&reader] { return reader.intensity(); }, reader.fields(), "intensity");
  decided.has_particles = !reader.has_read() || reader.count() > 0;
  decide_reference(part, camera, frame, decided);
  return decided;
}

DecidedScene FrameLoader::decide() {
  DecidedScene decided{scene_, {}};
  decided.scene.camera = decide_camera();
  const Frame frame = frame_of(*decided.scene.camera);
  for (Part& part : parts_)
    decided.components.push_back(decide_component(part, *decided.scene.camera, frame));
  return decided;
}

Frame FrameLoader::load(const DecidedScene& decided) {
  if (!decided.scene.camera || decided.components.size() != parts_.size()) {
    throw UsageError("the decided scene lacks its camera or a component, expected one of decide()");
  }
  read_background();
  Frame frame = frame_of(*decided.scene.camera);
  frame.background_image = background_;
  frame.spread = snapshot_.spread();
  auto numbers = decided.components.begin();
  for (Part& part : parts_) {
    DrawnComponent drawn = read(part, numbers->weight, decided.scene.camera->look_at);
    if (const auto note = tell_dark_color(part.reader.component(), drawn.palette))
      part.reader.fields().note(*note);
    drawn.color = numbers->color;
    drawn.intensity = numbers->intensity;
    drawn.reference_column = numbers->reference_column;
    if (const auto note = tell_rounded_positions(drawn, part.reader.fields().pass()))
      notes_.push_back(*note);
    frame.components.push_back(std::move(drawn));
    ++numbers;
  }
  for (const std::string& note : tell_color_bars(scene_, frame))
    notes_.push_back(note);
  return frame;
}

}  // namespace splotchcl
