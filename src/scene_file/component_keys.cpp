#include "formula/formula.h"
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

}  // namespace splotchcl::scene_file
