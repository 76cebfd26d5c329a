#include "load/frame_loader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "finish/bars.h"
#include "finish/finish_picture.h"
#include "image/image_library.h"
#include "load/component_fields.h"
#include "load/component_tree.h"
#include "load/components.h"
#include "load/placement.h"
#include "load/suggest_camera.h"
#include "scene/memory_advice.h"
#include "scene/particle_columns.h"
#include "scene/particle_rules.h"
#include "scene/scalar_map.h"
#include "scene/statistics.h"
#include "snapshot/load_memory.h"
#include "splotchcl/error.h"
#include "splotchcl/frame.h"
#include "splotchcl/particles.h"
#include "splotchcl/plan.h"

namespace splotchcl {
namespace {

// Throws DataError when a component has particles and all of them are bad, so that nothing of
// it could be drawn.
void check_particles(const DrawnComponent& component, const std::string& snapshot,
                     const ParticlePass& pass) {
  const Particles& particles = component.particles;
  const auto find_one = [&](const ParticleRun& run, std::vector<std::size_t>& good) {
    std::size_t i = run.begin;
    while (i < run.end && is_bad(particles, i))
      ++i;
    if (i < run.end) good.push_back(i);
  };
  if (particles.count == 0 || !pass.collect<std::size_t>(find_one).empty()) return;
  throw DataError(fmt::format(
      "{}: component {}: none of its {} particles can be drawn: all have a position, smoothing "
      "length, weight, colour, intensity or sort field that is not finite, a smoothing length not "
      "above 0, or a weight or own colour below 0; splotchcl info tells which",
      snapshot, component.name, particles.count));
}

// A limit of the scene on the scaled axis.
std::optional<double> scaled_limit(const std::optional<double>& limit, Scaling scaling,
                                   const std::string& label, const std::string& key) {
  if (!limit) return std::nullopt;
  const double value = scaled(*limit, scaling);
  if (!std::isfinite(value)) {
    throw UsageError(fmt::format(
        "{}: {} is {}, expected a number > 0, since the field is scaled by its logarithm; change "
        "the limit or the scaling",
        label, key, *limit));
  }
  return value;
}

// Of a range where the data give none: 1, or so much that large values differ by it.
double width_at(double value) {
  return std::max(1.0, 1e-3 * std::abs(value));
}

// Limits from the data, which must leave room for a limit that the scene gives.
ValueRange range_from_data(const ValuesToSample& data, const FieldMap& map,
                           const ComponentFields& fields) {
  std::optional<ValueRange> bulk;
  if (map.percentiles) {
    bulk = percentile_range(data.values, map.scaling, (*map.percentiles)[0], (*map.percentiles)[1],
                            data.pass);
  } else {
    bulk = bulk_range(data.values, map.scaling, data.pass);
  }
  if (!bulk && fields.count() == 0) return {0, 1};
  if (!bulk) {
    fields.note(
        fmt::format("no particle has a {} that its scaling has a value for; all take the "
                    "range's lower end",
                    map.field));
    return {0, 1};
  }
  if (bulk->minimum < bulk->maximum) return *bulk;
  fields.note(fmt::format("{} is the same for all particles; they take the middle of its range",
                          map.field));
  const double width = width_at(bulk->minimum);
  return {bulk->minimum - 0.5 * width, bulk->maximum + 0.5 * width};
}

// A field's way to [0, 1] with the limits that the scene leaves to the data; any where it names no
// field. `read` gives the field's values, and is called only where a limit is left to them. `key`
// names it in messages: "color". Throws UsageError for a limit that its scaling has no value for.
ScalarMap decide_map(const FieldMap& map, const std::function<ValuesToSample()>& read,
                     const ComponentFields& fields, const std::string& key) {
  ScalarMap decided;
  if (map.field.empty()) return decided;
  decided.scaling = map.scaling;
  const auto minimum = scaled_limit(map.minimum, map.scaling, fields.label(), key + ".min");
  const auto maximum = scaled_limit(map.maximum, map.scaling, fields.label(), key + ".max");
  if (minimum && maximum) {
    decided.minimum = *minimum;
    decided.maximum = *maximum;
    return decided;
  }
  const ValueRange data = range_from_data(read(), map, fields);
  decided.minimum = minimum.value_or(data.minimum);
  decided.maximum = maximum.value_or(data.maximum);
  if (decided.minimum < decided.maximum) return decided;
  // All data lie beyond the limit that is given: keep them all beyond it.
  if (minimum) {
    decided.maximum = *minimum + width_at(*minimum);
  } else {
    decided.minimum = decided.maximum - width_at(decided.maximum);
  }
  return decided;
}

// All values count where the smallest or largest of them is a limit.
bool is_sampled(const FieldMap& map) {
  return !map.percentiles || ((*map.percentiles)[0] > 0 && (*map.percentiles)[1] < 100);
}

// Of a component's color or intensity; `all` reads those of all particles.
ValuesToSample values_to_sample(ComponentReader& reader, WeightModel weight, const FieldMap& map,
                                Column Particles::*column,
                                const Column& (ComponentReader::*all)()) {
  const auto tree = is_sampled(map) ? reader.tree(weight) : nullptr;
  if (!tree || tree->sample.count == 0) {
    const Column values = (reader.*all)();
    return {values, 1, reader.fields().pass()};
  }
  return {tree->sample.*column, static_cast<std::size_t>(tree->sample_stride),
          ParticlePass(tree->sample.count)};
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
  return suggest_camera(suggest_target(snapshot, types, scene.image), scene.image);
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

// Neither shines nor absorbs.
bool is_dark(const Component& component) {
  return component.brightness == 0 && component.absorption.kind != Absorption::Kind::factor;
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
  require_chosen_components(scene);
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
  frame.fade = camera.fade;
  frame.lens = {camera.aperture, camera.focus.value_or(frame.camera.look_at_distance)};
  frame.background = scene_.image.background;
  frame.kernel = scene_.kernel;
  frame.sort = scene_.sort;
  frame.tolerance = scene_.tolerance;
  return frame;
}

const DrawnComponent& FrameLoader::read(Part& part, WeightModel weight, const Vec3& look_at) {
  if (part.drawn) return *part.drawn;
  DrawnComponent drawn = part.reader.drawn(weight);
  part.reader.fields().wrap_around(look_at, drawn.particles);
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
  const auto tree = drawn.particles.tree;
  const bool has_sample = tree && tree->sample.count > 0;
  if (has_sample) drawn.particles = tree->sample;
  const std::optional<double> reference = find_reference_column(
      drawn, frame, has_sample ? ParticlePass(drawn.particles.count) : part.reader.fields().pass(),
      has_sample ? static_cast<std::size_t>(tree->sample_stride) : 1);
  if (!reference && drawn.particles.count > 0) {
    const Column& weight = drawn.particles.weight;
    const bool is_without = !weight.is_absent() && !(find_statistics(weight).maximum > 0);
    notes_.push_back(fmt::format(
        "component {}: {}", drawn.name,
        is_without ? "all its particles have the weight 0, and it is not seen; masses and "
                     "densities below 1e-45 are read as 0"
                   : "the camera sees none of its particles; check camera.position, "
                     "camera.look_at and the near and far limits"));
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
  const auto color = [&] {
    return values_to_sample(reader, decided.weight, component.color, &Particles::color,
                            &ComponentReader::color);
  };
  const auto intensity = [&] {
    return values_to_sample(reader, decided.weight, component.intensity, &Particles::intensity,
                            &ComponentReader::intensity);
  };
  decided.color = decide_map(component.color, color, reader.fields(), "color");
  decided.intensity = decide_map(component.intensity, intensity, reader.fields(), "intensity");
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
    DrawnComponent drawn = is_dark(part.reader.component())
                               ? part.reader.dark(numbers->weight)
                               : read(part, numbers->weight, decided.scene.camera->look_at);
    if (const auto note = tell_dark_color(part.reader.component(), drawn.palette))
      part.reader.fields().note(*note);
    drawn.color = numbers->color;
    drawn.intensity = numbers->intensity;
    drawn.reference_column = numbers->reference_column;
    if (const auto note = part.reader.fields().rounded_positions(drawn)) notes_.push_back(*note);
    frame.components.push_back(std::move(drawn));
    ++numbers;
  }
  for (const std::string& note : tell_color_bars(scene_, frame))
    notes_.push_back(note);
  return frame;
}

}  // namespace splotchcl
