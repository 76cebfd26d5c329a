#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <list>
#include <memory>
#include <set>

#include "finish/finish_picture.h"
#include "image/background_image.h"
#include "load/check_particles.h"
#include "load/decide_map.h"
#include "load/load_frame_fields.h"
#include "load/periodic_wrap.h"
#include "load/suggest_scene_camera.h"
#include "scene/reference_column.h"
#include "snapshot/load_memory.h"
#include "splotchcl/error.h"
#include "splotchcl/load.h"
#include "splotchcl/palette_file.h"
#include "splotchcl/snapshot.h"
#include "splotchcl/snapshot_file.h"

namespace splotchcl {
namespace {

// The weight's values, and the model where the scene leaves it open.
void load_weight(const Component& component, const ComponentFields& fields, DrawnComponent& drawn) {
  drawn.weight = component.weight.value_or(fields.masses_are_known() ? WeightModel::mass
                                                                     : WeightModel::constant);
  switch (drawn.weight) {
    case WeightModel::mass:
      drawn.particles.weight = fields.masses();
      break;
    case WeightModel::density:
      drawn.particles.weight = fields.scalars("density", "weight = \"density\"");
      break;
    case WeightModel::constant:
      break;
  }
}

// Particles that vanish or appear between two snapshots are there only in part.
void apply_fade(const ComponentFields& fields, Particles& particles) {
  const Column fade = fields.fade();
  if (fade.is_absent()) return;
  std::vector<float> faded(particles.count);
  for (std::size_t i = 0; i < faded.size(); ++i)
    faded[i] = fade[i] * (particles.weight.is_absent() ? 1 : particles.weight[i]);
  particles.weight = Column::owning(std::move(faded));
}

void check_factor(double value, const ComponentFields& fields, const char* key) {
  if (!(value > 0) || !std::isfinite(value)) {
    throw UsageError(
        fmt::format("{}: {} is {}, expected a finite number > 0", fields.label(), key, value));
  }
}

// What a particle's own colour is multiplied with, and what it absorbs.
Palette choose_palette(const Component& component) {
  Palette palette;
  if (component.color_vector.empty()) {
    palette = load_palette(component.palette);
  } else {
    palette.name = "white";
    palette.emission = {Rgb{1, 1, 1}};
  }
  const std::string& other = component.absorption_palette;
  const bool is_the_same = component.color_vector.empty() && other == component.palette;
  if (other.empty() || is_the_same) return palette;
  const Palette absorbing = load_palette(other);
  palette.absorption = absorbing.has_own_absorption() ? absorbing.absorption : absorbing.emission;
  return palette;
}

// Lengths of the snapshot are scaled with it; a fixed size is a length of the scene.
double drawn_size_factor(const Component& component) {
  return component.size_fixed ? component.size_factor
                              : component.size_factor * component.placement.scale;
}

DrawnComponent load_component(const Component& component, const Scene& scene,
                              ComponentFields& fields) {
  fields.select();
  DrawnComponent drawn;
  drawn.name = component.name;
  drawn.size_factor = drawn_size_factor(component);
  drawn.brightness = component.brightness;
  drawn.absorption = component.absorption;
  drawn.palette = choose_palette(component);

  Particles& particles = drawn.particles;
  particles.count = fields.count();
  particles.origin = fields.origin();
  particles.position = fields.positions();
  particles.smoothing_length = fields.smoothing_lengths();
  load_weight(component, fields, drawn);
  apply_fade(fields, particles);
  if (!component.color.field.empty()) {
    particles.color = fields.scalars(component.color.field, "color.field");
    drawn.color = decide_map(component.color, particles.color, fields, "color");
  }
  if (!component.color_vector.empty()) {
    particles.color_vector = fields.vectors(component.color_vector, "color.vector");
  }
  if (!component.intensity.field.empty()) {
    particles.intensity = fields.scalars(component.intensity.field, "intensity.field");
    drawn.intensity = decide_map(component.intensity, particles.intensity, fields, "intensity");
  }
  if (scene.sort.by == SortOrder::By::field) {
    particles.sort_field = fields.scalars(scene.sort.field, "sort.by");
  }
  return drawn;
}

// After all else is decided: the reference follows from what the camera sees.
void decide_reference_column(const Component& component, const Frame& frame, DrawnComponent& drawn,
                             std::vector<std::string>& notes) {
  if (component.reference_column) {
    // The reference is that of all particles; those that are drawn stand for the others.
    drawn.reference_column = *component.reference_column / drawn.particles_per_drawn;
    return;
  }
  const std::optional<double> reference = find_reference_column(drawn, frame);
  if (!reference && drawn.particles.count > 0) {
    notes.push_back(
        fmt::format("component {}: the camera sees none of its particles; check camera.position, "
                    "camera.look_at and the near and far limits",
                    drawn.name));
  }
  drawn.reference_column = reference.value_or(1);
}

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
  return suggest_camera(snapshot, types, scene.image.width, scene.image.height);
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

// The components with their snapshots: whatever can be refused before anything is read.
class OpenComponents {
 public:
  OpenComponents(const Scene& scene, const Snapshot& snapshot, const MissingSizes& sizes,
                 std::vector<std::string>& notes) {
    for (const Component& component : scene.components) {
      const Snapshot* source = &snapshot;
      if (!component.snapshot.empty()) {
        companions_.push_back(snapshot.memory().companion(
            component.snapshot, [](const std::string& path) { return open_snapshot(path); }));
        source = companions_.back().get();
      }
      if (begun_.insert(source).second) source->memory().begin_load();
      fields_.emplace_back(component, *source, sizes, notes);
    }
    auto fields = fields_.begin();
    for (const Component& component : scene.components)
      check(component, scene.sort, *fields++);
  }

  std::list<ComponentFields>& fields() { return fields_; }

 private:
  static void check(const Component& component, const SortOrder& sort,
                    const ComponentFields& fields) {
    check_factor(component.size_factor, fields, "size.factor");
    if (component.size_fixed) check_factor(*component.size_fixed, fields, "size.fixed");
    check_factor(component.placement.scale, fields, "scale");
    check_placement(component, fields);
    fields.check(sort);
    choose_palette(component);
  }

  static void check_placement(const Component& component, const ComponentFields& fields) {
    const Placement& placement = component.placement;
    double largest = 0;
    for (const double component_of_axis : placement.axis.a)
      largest = std::max(largest, std::abs(component_of_axis));
    if (std::isfinite(placement.angle_degrees) && std::isfinite(largest) && largest > 0) return;
    throw UsageError(
        fmt::format("{}: rotation is by {} degrees about the axis ({}, {}, {}), expected finite "
                    "numbers and an axis that is not 0",
                    fields.label(), placement.angle_degrees, placement.axis.a[0],
                    placement.axis.a[1], placement.axis.a[2]));
  }

  std::vector<std::shared_ptr<const Snapshot>> companions_;
  std::set<const Snapshot*> begun_;
  std::list<ComponentFields> fields_;
};

}  // namespace

void check_load(const Scene& scene, const Snapshot& snapshot) {
  check_finish(scene, snapshot.info());
  std::vector<std::string> ignored;
  OpenComponents(scene, snapshot, missing_sizes(scene, {}), ignored);
}

Frame load_frame(const Scene& scene, const Snapshot& snapshot, std::vector<std::string>& notes,
                 const LoadProgress& progress) {
  if (scene.components.empty()) {
    throw UsageError("the scene has no component, expected at least one; add a [[component]]");
  }
  check_finish(scene, snapshot.info());
  const double box = scene.periodic.wrap ? periodic_box(scene.periodic, snapshot.info()) : 0;
  OpenComponents components(scene, snapshot, missing_sizes(scene, progress), notes);
  const Camera camera = choose_camera(scene, snapshot);
  Frame frame;
  frame.width = scene.image.width;
  frame.height = scene.image.height;
  frame.crop = {0, 0, frame.width, frame.height};
  frame.camera = make_camera_frame(camera, frame.width, frame.height);
  if (scene.image.convention == PixelConvention::original) {
    frame.camera = in_original_convention(frame.camera);
  }
  frame.projection = camera.projection;
  frame.near_limit = camera.near_limit;
  frame.far_limit = camera.far_limit;
  frame.background = scene.image.background;
  frame.background_image = background_image(scene.image, snapshot);
  frame.kernel = scene.kernel;
  frame.sort = scene.sort;
  frame.tolerance = scene.tolerance;
  auto fields = components.fields().begin();
  for (const Component& component : scene.components) {
    const SnapshotInfo& info = fields->snapshot_info();
    DrawnComponent drawn = load_component(component, scene, *fields++);
    // What is placed elsewhere is no part of the periodic box.
    if (scene.periodic.wrap && component.snapshot.empty() && !component.placement.moves()) {
      wrap_around(camera.look_at, box, drawn.particles);
    }
    check_particles(drawn, info.files.front().string());
    drawn.particles_per_drawn = info.particles_per_drawn;
    decide_reference_column(component, frame, drawn, notes);
    frame.components.push_back(std::move(drawn));
  }
  return frame;
}

}  // namespace splotchcl
