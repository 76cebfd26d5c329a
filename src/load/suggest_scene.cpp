// The scene that is drawn when only a snapshot is given. Every choice here is one of
// taste, made by looking at pictures; a scene file overrides any of it.
#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>

#include "common/words.h"
#include "load/component_tree.h"
#include "load/passes.h"
#include "load/press_look.h"
#include "load/suggest_camera.h"
#include "scene/particle_columns.h"
#include "scene/statistics.h"
#include "snapshot/field_names.h"
#include "splotchcl/error.h"
#include "splotchcl/load.h"
#include "splotchcl/scene.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {
namespace {

// From a scene in Look::press, before its light is finished: matter is ink, which gives off no
// light and absorbs that of white paper.
void change_to_paper(Scene& scene) {
  for (Component& component : scene.components) {
    if (component.brightness == 0) continue;  // dust is ink as it is
    component.absorption = {Absorption::Kind::factor, component.brightness};
    component.brightness = 0;
    component.color_vector.clear();
    component.palette = component.color.field.empty() ? "white" : "ink";
  }
  scene.image.background = {1, 1, 1};
  scene.finish = FinishSettings();
  scene.finish.text_color = {0, 0, 0};
}

constexpr int gas = 0, halo = 1, disk = 2, bulge = 3, stars = 4;

// What displays expect.
constexpr double gamma = 2.2;

// Powers of ten, or parts of the unit on a linear scale, that a field must span to give
// a picture colours.
constexpr double smallest_span = 0.05;

// Three digits: a limit that a user may want to read and change.
double rounded(double value) {
  return value == 0 ? 0 : round_to_decimals(value, decimals_for(value, 3));
}

// Where the bulk of the values lies. Of a logarithm that reaches down to what are almost zeros, the
// lower end is cut at as many per cent as it takes.
std::optional<ValueRange> robust_range(const Column& column, Scaling scaling,
                                       const ParticlePass& pass) {
  constexpr double largest_span = 8;  // powers of ten
  std::optional<ValueRange> range = bulk_range(column, scaling, pass);
  if (!range || scaling != Scaling::log) return range;
  for (const double low : {1.0, 2.0, 5.0, 10.0, 20.0, 50.0}) {
    if (range->maximum - range->minimum <= largest_span) break;
    range = percentile_range(column, scaling, low, 99.5, pass);
  }
  range->minimum = std::max(range->minimum, range->maximum - largest_span);
  return range;
}

// The field with its limits spelled out, if the type has it and it has something to show.
std::optional<FieldMap> varying_field(const Snapshot& snapshot, const ParticleTypeInfo& type,
                                      const std::string& field, Scaling scaling) {
  const FieldInfo* const info = find_field(type, field);
  if (info == nullptr || info->values_per_particle != 1) return std::nullopt;
  const ValuesToSample sample = values_to_sample(snapshot, type.type, field);
  const auto range = robust_range(sample.values, scaling, sample.pass);
  if (!range) return std::nullopt;
  const double scale = scaling == Scaling::log ? 1.0 : std::abs(range->maximum);
  if (!(range->maximum - range->minimum > smallest_span * scale)) return std::nullopt;
  FieldMap map{field, scaling, {}, {}};
  const bool is_log = scaling == Scaling::log;
  map.minimum = rounded(is_log ? std::pow(10, range->minimum) : range->minimum);
  map.maximum = rounded(is_log ? std::pow(10, range->maximum) : range->maximum);
  return map;
}

bool are_light(const Column& colors, const ParticlePass& pass) {
  const auto find_others = [&](const ParticleRun& run, std::vector<std::size_t>& others) {
    for_stretches(run, [&](std::size_t begin, std::size_t end) {
      if (!others.empty()) return;
      const ColumnStretch stretch(colors, 3 * begin, 3 * end);
      for (std::size_t i = 3 * begin; i < 3 * end && others.empty(); ++i) {
        if (!std::isfinite(stretch[i]) || stretch[i] < 0) others.push_back(i);
      }
    });
  };
  return pass.collect<std::size_t>(find_others).empty();
}

// A field of one of these names: three values, none below 0. Empty where there is none.
std::string field_of_colors(const Snapshot& snapshot, const ParticleTypeInfo& type,
                            std::initializer_list<const char*> names) {
  for (const FieldInfo& field : type.fields) {
    const bool is_named_so = std::any_of(names.begin(), names.end(), [&](const char* name) {
      return equal_ignoring_case(field.name, name);
    });
    if (!is_named_so || field.values_per_particle != 3) continue;
    if (are_light(snapshot.read(type.type, field.name), pass_over(snapshot, type.type)))
      return field.name;
  }
  return {};
}

// Of particles that have colours of their own.
std::string own_colors(const Snapshot& snapshot, const ParticleTypeInfo& type) {
  return field_of_colors(snapshot, type, {"color", "colors", "rgb"});
}

// Of particles that give off no light but absorb it, as the dust of splotchcl galaxy.
std::string own_opacity(const Snapshot& snapshot, const ParticleTypeInfo& type) {
  return field_of_colors(snapshot, type, {"opacity"});
}

// load_frame estimates it where the file has none; its range is not known before.
FieldMap estimated_density(Scaling scaling) {
  return {"density", scaling, {}, {}};
}

Component component_for(const ParticleTypeInfo& type) {
  Component component;
  component.name = particle_type_name(type.type);
  component.types = {type.type};
  component.weight = has_masses(type) ? WeightModel::mass : WeightModel::constant;
  component.absorption = {Absorption::Kind::none, 0};
  return component;
}

// In gas whose heat hardly varies the density is what there is to see.
bool tells_more(const FieldMap& density, const FieldMap& heat) {
  constexpr double much_heat = 2;  // largest over smallest
  const auto ratio = [](const FieldMap& map) { return *map.maximum / *map.minimum; };
  return ratio(heat) < much_heat && ratio(density) > ratio(heat);
}

Component gas_component(const Snapshot& snapshot, const ParticleTypeInfo& type) {
  Component component = component_for(type);
  const auto density = varying_field(snapshot, type, "density", Scaling::log);
  for (const char* const heat : {"temperature", "internal_energy"}) {
    const auto map = varying_field(snapshot, type, heat, Scaling::log);
    if (!map || (density && tells_more(*density, *map))) continue;
    component.color = *map;
    component.palette = "hot_gas";
    return component;
  }
  component.color = density.value_or(estimated_density(Scaling::log));
  component.palette = density ? "gas" : "hot_gas";
  return component;
}

Component star_component(const Snapshot& snapshot, const ParticleTypeInfo& type) {
  Component component = component_for(type);
  component.palette = "stars";
  // A length that reaches to the 64th neighbour would reach across all of a few.
  constexpr std::uint64_t few = 512;
  if (type.count < few && find_field(type, "smoothing_length") == nullptr) {
    component.size_factor = 0.2;
  }
  component.color = varying_field(snapshot, type, "stellar_age", Scaling::linear)
                        .value_or(estimated_density(Scaling::log));
  return component;
}

// Discs and stars are bright against the halo that they lie in, which is but a glow
// around them; dark matter by itself is the picture.
Component collisionless_component(const Snapshot& snapshot, const ParticleTypeInfo& type,
                                  bool is_alone) {
  if (type.type == stars) return star_component(snapshot, type);
  Component component = component_for(type);
  component.color = estimated_density(Scaling::log);
  component.palette = type.type == halo ? "halo" : "hot_gas";
  if (!is_alone) component.brightness = type.type == halo ? 0.2 : 2.5;
  return component;
}

// Whether the file gives all particles of a type the same smoothing length.
bool has_one_size(const Snapshot& snapshot, int type) {
  if (find_field(*snapshot.info().find_type(type), "smoothing_length") == nullptr) return false;
  const Column lengths = snapshot.read(type, "smoothing_length");
  if (lengths.is_uniform()) return true;
  // Of each run the first one, and the first that differs from it.
  const auto find_two = [&](const ParticleRun& run, std::vector<float>& some) {
    for_stretches(run, [&](std::size_t begin, std::size_t end) {
      if (some.size() == 2) return;
      const ColumnStretch stretch(lengths, begin, end);
      for (std::size_t i = begin; i < end && some.size() < 2; ++i) {
        if (some.empty() || stretch[i] != some.front()) some.push_back(stretch[i]);
      }
    });
  };
  const std::vector<float> some = pass_over(snapshot, type).collect<float>(find_two);
  return std::all_of(some.begin(), some.end(),
                     [&some](float length) { return length == some.front(); });
}

void give_own_colors(Component& component, const std::string& field) {
  component.color = FieldMap();
  component.intensity = FieldMap();
  component.color_vector = field;
  component.brightness = 1;
}

// Its weights are areas times optical depths.
Component dust_component(const ParticleTypeInfo& type, const std::string& opacity) {
  Component component = component_for(type);
  component.name = "dust";
  give_own_colors(component, opacity);
  component.brightness = 0;
  component.absorption = {Absorption::Kind::factor, 1};
  component.reference_column = 1;
  return component;
}

Component type_component(const Snapshot& snapshot, const ParticleTypeInfo& type, bool is_alone) {
  Component component = type.type == gas ? gas_component(snapshot, type)
                                         : collisionless_component(snapshot, type, is_alone);
  const std::string colors = own_colors(snapshot, type);
  if (!colors.empty()) give_own_colors(component, colors);
  return component;
}

// Gas with the stars in it; dark matter beside gas would only veil it. Discs and bulges are stars
// of a galaxy by itself, but in a universe the dark matter far from what is looked at.
bool is_drawn_beside_gas(int type, const SnapshotInfo& info) {
  const bool is_of_galaxy = type == disk || type == bulge;
  return type == gas || type == stars || (is_of_galaxy && !info.cosmology);
}

// Types with colours of their own are one kind of light, as bright as each other.
std::optional<Component> colored_component(const Snapshot& snapshot) {
  Component component;
  std::string field;
  for (const ParticleTypeInfo& type : snapshot.info().types) {
    const std::string colors = own_colors(snapshot, type);
    if (colors.empty() || (!field.empty() && colors != field)) continue;
    if (field.empty()) {
      component = component_for(type);
      component.types.clear();
    }
    field = colors;
    component.types.push_back(type.type);
    if (!has_masses(type)) component.weight = WeightModel::constant;
  }
  if (component.types.size() < 2 || field.empty()) return std::nullopt;
  component.name = "colored";
  give_own_colors(component, field);
  return component;
}

std::vector<Component> choose_components(const Snapshot& snapshot) {
  std::vector<Component> components;
  const SnapshotInfo& info = snapshot.info();
  const bool has_gas = info.find_type(gas) != nullptr;
  const std::optional<Component> colored = colored_component(snapshot);
  if (colored) components.push_back(*colored);
  for (const ParticleTypeInfo& type : info.types) {
    const std::string opacity = own_opacity(snapshot, type);
    if (!opacity.empty() && info.types.size() > 1 && has_masses(type)) {
      components.push_back(dust_component(type, opacity));
      continue;
    }
    const bool is_colored = colored && std::find(colored->types.begin(), colored->types.end(),
                                                 type.type) != colored->types.end();
    if (is_colored || (has_gas && !is_drawn_beside_gas(type.type, info))) continue;
    components.push_back(type_component(snapshot, type, info.types.size() == 1));
  }
  return components;
}

// Of several types together: what any particle has.
Component joint_component(const Snapshot& snapshot, const std::vector<int>& types) {
  Component component;
  component.types = types;
  component.absorption = {Absorption::Kind::none, 0};
  component.color = estimated_density(Scaling::log);
  component.palette = "hot_gas";
  const bool have_masses = std::all_of(types.begin(), types.end(), [&](int type) {
    const ParticleTypeInfo* const info = snapshot.info().find_type(type);
    return info == nullptr || has_masses(*info);
  });
  component.weight = have_masses ? WeightModel::mass : WeightModel::constant;
  return component;
}

// Whether lengths that reach to the 64th neighbour reach across much of the picture.
bool are_few(const Snapshot& snapshot, int type) {
  constexpr std::uint64_t few = 4096;
  const ParticleTypeInfo& info = *snapshot.info().find_type(type);
  return type == gas && info.count < few && find_field(info, "smoothing_length") == nullptr;
}

// Initial conditions and even boxes: every line of sight shows the same, unless what is denser than
// the rest stands out. Where all have one size, no density says what is denser, but smaller clouds
// show how they lie, as they do where particles are few.
void show_contrast(const Snapshot& snapshot, Component& component) {
  if (component.color.field != "density") return;
  constexpr std::array<double, 2> upper_half = {50, 99.9};
  component.color.minimum.reset();
  component.color.maximum.reset();
  component.color.percentiles = upper_half;
  component.intensity = estimated_density(Scaling::linear);
  component.intensity.percentiles = upper_half;
  constexpr double small = 0.25;
  const int type = component.types.front();
  if (has_one_size(snapshot, type) || are_few(snapshot, type)) component.size_factor = small;
}

// Matter absorbs nothing, so that light adds up: columns of it span far more than a display does,
// and what is dense would be as white as what is denser. The tone curve brings it within reach.
void show_all_light(FinishSettings& finish) {
  finish.exposure.reset();
  finish.tone = ToneCurve::filmic;
  finish.white.reset();
}

// The rest is faint in it, and is not veiled.
constexpr double faint = 0.25;

void change_to_press(const Snapshot& snapshot, Scene& scene) {
  const SnapshotInfo& info = snapshot.info();
  const bool lacks_halo = info.find_type(gas) != nullptr;
  if (lacks_halo && dark_matter_carries_picture(info)) {
    scene.components.push_back(type_component(snapshot, *info.find_type(halo), false));
    scene.components.back().brightness = faint;
  }
  for (Component& component : scene.components)
    component = in_press_look(component, snapshot);
  finish_for_press(scene.finish);
}

}  // namespace

Component suggest_component(const Snapshot& snapshot, const std::vector<int>& types, Look look) {
  const ParticleTypeInfo* const only =
      types.size() == 1 ? snapshot.info().find_type(types.front()) : nullptr;
  const Component component =
      only != nullptr ? type_component(snapshot, *only, true) : joint_component(snapshot, types);
  return look == Look::classic ? component : in_press_look(component, snapshot);
}

std::string tell_not_drawn(const Scene& scene, const Snapshot& snapshot) {
  std::string text;
  for (const ParticleTypeInfo& type : snapshot.info().types) {
    const bool is_drawn = std::any_of(
        scene.components.begin(), scene.components.end(), [&type](const Component& component) {
          return component.snapshot.empty() &&
                 std::find(component.types.begin(), component.types.end(), type.type) !=
                     component.types.end();
        });
    if (is_drawn) continue;
    text += (text.empty() ? "not drawn: " : ", ") + particle_type_name(type.type) + " " +
            std::to_string(type.count);
  }
  return text;
}

Scene suggest_scene(const Snapshot& snapshot, Look look, const ImageSettings& image) {
  const SnapshotInfo& info = snapshot.info();
  if (info.types.empty()) {
    throw DataError(info.files.front().string() +
                    ": the snapshot holds no particles, expected some to draw");
  }
  Scene scene;
  scene.snapshot = info.files.front().string();
  require_utf8(scene.snapshot);
  scene.image.gamma = gamma;
  show_all_light(scene.finish);
  scene.components = choose_components(snapshot);
  const Target target = suggest_target(snapshot, types_of(scene.components), image);
  scene.camera = suggest_camera(target, image);
  if (look != Look::classic) change_to_press(snapshot, scene);
  if (look == Look::paper) change_to_paper(scene);
  if (target.is_smooth) {
    for (Component& component : scene.components)
      show_contrast(snapshot, component);
  }
  return scene;
}

}  // namespace splotchcl
