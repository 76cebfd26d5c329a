// Which particles a component has, and where they are put.
#include <fmt/format.h>

#include "scene_file/key_builder.h"
#include "select/selection.h"

namespace splotchcl::scene_file {
namespace {

using Texts = std::vector<std::string>;

// A condition, or an array of them.
std::optional<Texts> read_conditions(const toml::node& node) {
  Texts conditions;
  if (const auto single = node.value_exact<std::string>()) conditions.push_back(*single);
  if (const toml::array* const array = node.as_array()) {
    for (const toml::node& element : *array) {
      const auto text = element.value_exact<std::string>();
      if (!text) return std::nullopt;
      conditions.push_back(*text);
    }
  }
  for (const std::string& condition : conditions)
    parse_condition(condition, "condition");
  return conditions.empty() ? std::nullopt : std::optional(conditions);
}

std::string write_conditions(const Texts& conditions) {
  Texts quoted;
  for (const std::string& condition : conditions)
    quoted.push_back(write_text(condition));
  return fmt::format("[{}]", fmt::join(quoted, ", "));
}

ValueType<Texts> conditions() {
  return {condition_form, read_conditions, write_conditions};
}

// select.* and exclude.*. The latter's words refer to the former's.
Keys set_keys(const std::string& path, ParticleSet Component::*set) {
  const bool leaves_out = path == "component.exclude";
  const auto meaning = [=](const std::string& name, const std::string& text) {
    return leaves_out ? "As `select" + name + "`, of particles that are left out." : text;
  };
  const auto optional_vector = [&](const std::string& name,
                                   std::optional<Vec3> ParticleSet::*member,
                                   const std::string& text) {
    return key<Component, Vec3>(
        path + name, vector(), [=](const Component& component) { return component.*set.*member; },
        [=](Component& component, const Vec3& value) { component.*set.*member = value; },
        {meaning(name, text), "length", "not used"});
  };
  return {
      key<Component, Texts>(
          path + ".where", conditions(),
          [=](const Component& component) {
            const Texts& where = (component.*set).where;
            return where.empty() ? std::nullopt : std::optional(where);
          },
          [=](Component& component, const Texts& value) { (component.*set).where = value; },
          {meaning(".where", "Only particles whose fields fulfil this."), "", "not used"}),
      key<Component, std::string>(
          path + ".ids", text(),
          [=](const Component& component) {
            const std::string& file = (component.*set).id_file;
            return file.empty() ? std::nullopt : std::optional(file);
          },
          [=](Component& component, const std::string& value) { (component.*set).id_file = value; },
          {meaning(".ids",
                   "Only particles whose ids this file lists: text, one per line, or a NumPy array "
                   "(.npy)."),
           "", "not used"}),
      key<Component, std::uint64_t>(
          path + ".halo", identifier(),
          [=](const Component& component) { return (component.*set).halo; },
          [=](Component& component, std::uint64_t value) { (component.*set).halo = value; },
          {meaning(".halo",
                   "Only particles of this halo, by its number in the snapshot or in the catalog; "
                   "see formats.md."),
           "", "not used"}),
      key<Component, std::string>(
          path + ".catalog", text(),
          [=](const Component& component) {
            const std::string& file = (component.*set).halo_catalog;
            return file.empty() ? std::nullopt : std::optional(file);
          },
          [=](Component& component, const std::string& value) {
            (component.*set).halo_catalog = value;
          },
          {meaning(".catalog", "The catalog for `halo`."), "",
           "the snapshot's group ids, else a catalog beside it"}),
      optional_vector(".box.min", &ParticleSet::box_minimum,
                      "Only particles from this corner of a box to `box.max`."),
      optional_vector(".box.max", &ParticleSet::box_maximum, "The other corner."),
      optional_vector(".sphere.center", &ParticleSet::sphere_center,
                      "Only particles within `sphere.radius` of here."),
      key<Component, double>(
          path + ".sphere.radius", number(more_than(0)),
          [=](const Component& component) { return (component.*set).sphere_radius; },
          [=](Component& component, double value) { (component.*set).sphere_radius = value; },
          {meaning(".sphere.radius", "The sphere's radius."), "length", "not used"}),
  };
}

Key rim_key() {
  return key<Component, double>(
      "component.select.sphere.rim", number(more_than(0)),
      [](const Component& component) { return component.select.sphere_rim; },
      [](Component& component, double value) { component.select.sphere_rim = value; },
      {"Weights fall smoothly to 0 over so much within `sphere.radius`.", "length", "not used"});
}

bool equal(const Vec3& a, const Vec3& b) {
  return a.a[0] == b.a[0] && a.a[1] == b.a[1] && a.a[2] == b.a[2];
}

// Most components are not placed anywhere: defaults are not written.
Keys placement_keys() {
  return {
      key<Component, Vec3>(
          "component.center", vector(),
          [](const Component& component) {
            return equal(component.center, Component().center) ? std::nullopt
                                                               : std::optional(component.center);
          },
          [](Component& component, const Vec3& value) { component.center = value; },
          {"A point in the snapshot's coordinates: `radius` is measured from it, `origin` places "
           "it, and turning and scaling leave it in place.",
           "length", "`[0, 0, 0]`"}),
      key<Component, Vec3>(
          "component.origin", vector(),
          [](const Component& component) { return component.placement.origin; },
          [](Component& component, const Vec3& value) { component.placement.origin = value; },
          {"Where in the scene `center` is put, in double precision.", "length",
           "where `center` is"}),
      key<Component, Vec3>(
          "component.rotation.axis", vector(),
          [](const Component& component) {
            const Vec3& axis = component.placement.axis;
            return equal(axis, Placement().axis) ? std::nullopt : std::optional(axis);
          },
          [](Component& component, const Vec3& value) { component.placement.axis = value; },
          {"The axis through `center` about which it is turned.", "", "`[0, 0, 1]`"}),
      key<Component, double>(
          "component.rotation.angle", number(),
          [](const Component& component) {
            const double angle = component.placement.angle_degrees;
            return angle == 0 ? std::nullopt : std::optional(angle);
          },
          [](Component& component, double value) { component.placement.angle_degrees = value; },
          {"By how much, right-handed.", "degrees", "`0`"}),
      key<Component, double>(
          "component.scale", number(more_than(0)),
          [](const Component& component) {
            const double scale = component.placement.scale;
            return scale == 1 ? std::nullopt : std::optional(scale);
          },
          [](Component& component, double value) { component.placement.scale = value; },
          {"A length of 1 in its snapshot becomes this length in the scene. Sizes h too, except "
           "`size.fixed`.",
           "", "`1`"}),
  };
}

}  // namespace

Keys particle_keys() {
  Keys keys = {
      key<Component, std::string>(
          "component.snapshot", text(),
          [](const Component& component) {
            return component.snapshot.empty() ? std::nullopt : std::optional(component.snapshot);
          },
          [](Component& component, const std::string& value) { component.snapshot = value; },
          {"A snapshot of its own, read as `[read]` says.", "", "the scene's"}),
      key("component.types", particle_types(), &Component::types,
          {"The particle types drawn as this component."}),
  };
  append(keys, set_keys("component.select", &Component::select));
  keys.push_back(rim_key());
  append(keys, set_keys("component.exclude", &Component::exclude));
  append(keys, placement_keys());
  return keys;
}

}  // namespace splotchcl::scene_file
