// Keys of a component: how it looks, which particles it has, and where they are put.
#include <fmt/format.h>

#include "formula/formula.h"
#include "formula/selection.h"
#include "scene_file/key_builder.h"

namespace splotchcl::scene_file {
namespace {

using Percentiles = std::array<double, 2>;

ValueType<std::string> formula_text() {
  const auto read = [](const toml::node& node) {
    const auto found = node.value_exact<std::string>();
    if (found) Formula::parse(*found, "formula");
    return found;
  };
  return {"a formula", read, write_text};
}

// color.* and intensity.*. Without a field the others mean nothing and are not written.
Keys field_map_keys(const std::string& path, FieldMap Component::*map, const Text& field_text) {
  const auto optional_number = [map](std::optional<double> FieldMap::*member) {
    return [map, member](const Component& component) -> std::optional<double> {
      const FieldMap& field_map = component.*map;
      return field_map.field.empty() ? std::nullopt : field_map.*member;
    };
  };
  const auto set_number = [map](std::optional<double> FieldMap::*member) {
    return [map, member](Component& component, double value) { component.*map.*member = value; };
  };
  return {
      key<Component, std::string>(
          path + ".field", text(),
          [map](const Component& component) {
            const std::string& field = (component.*map).field;
            return field.empty() ? std::nullopt : std::optional(field);
          },
          [map](Component& component, const std::string& value) { (component.*map).field = value; },
          field_text),
      not_written(excluding(key<Component, std::string>(
                                path + ".formula", formula_text(),
                                [map](const Component& component) {
                                  const std::string& field = (component.*map).field;
                                  return field.empty() ? std::nullopt : std::optional(field);
                                },
                                [map](Component& component, const std::string& value) {
                                  (component.*map).field = value;
                                },
                                {"Instead of `field`: see [Formulas](#formulas).", "", "none"}),
                            {path + ".field"})),
      key<Component, Scaling>(
          path + ".scaling",
          choice<Scaling>({{"linear", Scaling::linear},
                           {"log", Scaling::log},
                           {"asinh", Scaling::asinh},
                           {"log10", Scaling::log}}),
          [map](const Component& component) {
            const FieldMap& field_map = component.*map;
            return field_map.field.empty() ? std::nullopt : std::optional(field_map.scaling);
          },
          [map](Component& component, Scaling value) { (component.*map).scaling = value; },
          {"`log` is log10; values <= 0 count as the lowest.", "", "`\"linear\"`"}),
      key<Component, double>(path + ".min", number(), optional_number(&FieldMap::minimum),
                             set_number(&FieldMap::minimum),
                             {"The value, before scaling, that becomes 0, as lower ones do.",
                              "the field's", "a percentile of the data"}),
      key<Component, double>(path + ".max", number(), optional_number(&FieldMap::maximum),
                             set_number(&FieldMap::maximum),
                             {"The value, before scaling, that becomes 1, as higher ones do.",
                              "the field's", "a percentile of the data"}),
      key<Component, Percentiles>(
          path + ".percentiles", percentiles(),
          [map](const Component& component) {
            const FieldMap& field_map = component.*map;
            return field_map.field.empty() ? std::nullopt : field_map.percentiles;
          },
          [map](Component& component, const Percentiles& value) {
            (component.*map).percentiles = value;
          },
          {"Percentiles of the component's particles for a missing min or max.", "per cent",
           "`[0.5, 99.5]`"}),
  };
}

// A field and a fixed size replace each other, so that a setting can change a scene's mind.
Keys size_keys() {
  return {
      excluding(key<Component, std::string>(
                    "component.size.field", text(),
                    [](const Component& component) {
                      return component.size_fixed ? std::nullopt
                                                  : std::optional(component.size_field);
                    },
                    [](Component& component, const std::string& value) {
                      component.size_field = value;
                      component.size_fixed.reset();
                    },
                    {"The field that holds h, the radius of each particle's cloud."}),
                {"component.size.fixed"}),
      key<Component, double>(
          "component.size.fixed", number(more_than(0)),
          [](const Component& component) { return component.size_fixed; },
          [](Component& component, double value) {
            component.size_field = Component().size_field;
            component.size_fixed = value;
          },
          {"The same h for every particle, instead of a field.", "length", "not fixed"}),
      key("component.size.factor", number(more_than(0)), &Component::size_factor,
          {"The h that is drawn is factor * h."}),
  };
}

Keys absorption_keys() {
  using Kind = Absorption::Kind;
  return {
      excluding(
          key<Component, Absorption>(
              "component.absorption", absorption(),
              [](const Component& component) {
                return component.absorption.kind == Kind::gray
                           ? std::nullopt
                           : std::optional(component.absorption);
              },
              [](Component& component, const Absorption& value) { component.absorption = value; },
              {"What matter absorbs. `\"emission\"`: as much as it emits, A = E. `\"none\"`: "
               "nothing. A number: A = number * palette_A."}),
          {"component.gray_absorption"}),
      key<Component, double>(
          "component.gray_absorption", number(light()),
          [](const Component& component) {
            return component.absorption.kind == Kind::gray
                       ? std::optional(component.absorption.factor)
                       : std::nullopt;
          },
          [](Component& component, double value) {
            component.absorption = {Kind::gray, value};
          },
          {"Instead of `absorption`, the original program's rule; see the model of light.", "",
           "not used"}),
  };
}

}  // namespace

Keys component_keys() {
  Keys keys = {
      key<Component, std::string>(
          "component.name", text(),
          [](const Component& component) {
            return component.name.empty() ? std::nullopt : std::optional(component.name);
          },
          [](Component& component, const std::string& value) { component.name = value; },
          {"For messages and settings such as `component.NAME.palette`. Not only digits.", "",
           "none"}),
  };
  append(keys, particle_keys());
  append(keys, size_keys());
  append(keys, field_map_keys("component.color", &Component::color,
                              {"The field looked up in the palette.", "",
                               "none: the palette's first colour for all, black in many"}));
  keys.push_back(key<Component, std::string>(
      "component.color.vector", text(),
      [](const Component& component) {
        return component.color_vector.empty() ? std::nullopt
                                              : std::optional(component.color_vector);
      },
      [](Component& component, const std::string& value) { component.color_vector = value; },
      {"A field of three values, each particle's own red, green and blue, instead of the palette's "
       "emission.",
       "", "none"}));
  append(keys, field_map_keys("component.intensity", &Component::intensity,
                              {"The field that becomes I, a factor on emission and absorption.", "",
                               "none: I = 1"}));
  append(keys,
         {
             key("component.weight",
                 choice<WeightModel>({{"mass", WeightModel::mass},
                                      {"density", WeightModel::density},
                                      {"constant", WeightModel::constant}}),
                 &Component::weight,
                 {"What the column w of a cloud is made of; see the model of light.", "",
                  "`\"mass\"` where masses are known, else `\"constant\"`"}),
             key("component.reference_column", number(more_than(0)), &Component::reference_column,
                 {"The column w that counts as 1: w is divided by it.", "that of w",
                  "a percentile of the data"}),
             key("component.palette", text(), &Component::palette,
                 {"A palette's name, or a file; see palettes.md."}),
             key<Component, std::string>(
                 "component.absorption_palette", text(),
                 [](const Component& component) {
                   return component.absorption_palette.empty()
                              ? std::nullopt
                              : std::optional(component.absorption_palette);
                 },
                 [](Component& component, const std::string& value) {
                   component.absorption_palette = value;
                 },
                 {"The palette that gives palette_A.", "", "what `palette` says"}),
             key("component.brightness", number(light()), &Component::brightness,
                 {"Factor on the palette's colours."}),
         });
  append(keys, absorption_keys());
  return keys;
}

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
