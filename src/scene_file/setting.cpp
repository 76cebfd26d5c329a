#include "scene_file/setting.h"

#include <fmt/format.h>

#include <cstddef>
#include <optional>
#include <vector>

#include "common/nearest_name.h"
#include "common/words.h"
#include "scene_file/check.h"
#include "scene_file/key_depth.h"
#include "scene_file/parse_toml.h"
#include "scene_file/values.h"
#include "splotchcl/error.h"

namespace splotchcl::scene_file {
namespace {

const std::string component_prefix = "component.";

// "gas" and "gas.size" address the component "gas"; the names may hold dots themselves.
bool addresses(const std::string& address, const std::string& name) {
  return !name.empty() && address.compare(0, name.size(), name) == 0 &&
         (address.size() == name.size() || address[name.size()] == '.');
}

struct Found {
  std::size_t component;
  std::size_t address_length;  // of "0" or "gas"
};

std::optional<Found> find_by_name(const std::string& address, const Scene& scene) {
  std::optional<Found> longest;
  for (std::size_t i = 0; i < scene.components.size(); ++i) {
    const std::string& name = scene.components[i].name;
    if (!addresses(address, name)) continue;
    if (!longest || name.size() > longest->address_length) longest = Found{i, name.size()};
  }
  return longest;
}

std::optional<Found> find_by_number(const std::string& address, const Scene& scene) {
  const std::string digits = address.substr(0, address.find('.'));
  if (digits.empty() || digits.find_first_not_of("0123456789") != std::string::npos) {
    return std::nullopt;
  }
  for (std::size_t i = 0; i < scene.components.size(); ++i) {
    if (digits == std::to_string(i)) return Found{i, digits.size()};
  }
  return std::nullopt;
}

[[noreturn]] void refuse_component(const std::string& address, const Scene& scene,
                                   const std::string& where) {
  const std::string name = address.substr(0, address.find('.'));
  std::vector<std::string> names;
  for (const Component& component : scene.components) {
    if (!component.name.empty()) names.push_back(component.name);
  }
  std::string expected = "a scene that has components";
  if (!scene.components.empty()) {
    expected = fmt::format("a number from 0 to {}", scene.components.size() - 1);
    if (!names.empty()) expected += fmt::format(" or a name ({})", fmt::join(names, ", "));
  }
  refuse(where, component_prefix + name, "no such component", expected,
         did_you_mean(nearest_name(name, names)));
}

}  // namespace

Setting split_setting(const std::string& setting) {
  const std::size_t equals = setting.find('=');
  const std::string key = trimmed(setting.substr(0, equals));
  if (equals == std::string::npos || key.empty()) {
    throw UsageError(
        fmt::format("setting \"{}\": found no key with a value, expected key=value, "
                    "such as camera.field_of_view=30",
                    one_line(setting)));
  }
  return {key, trimmed(setting.substr(equals + 1))};
}

toml::table parse_value(const std::string& text) {
  if (find_deep_key(text) > 0) return toml::table{{"value", text}};
  try {
    toml::table table = parse_toml("value = " + text);
    if (table.size() == 1 && table.contains("value")) return table;
  } catch (const toml::parse_error&) {
    // A bare word: palette=magma.
  }
  return toml::table{{"value", text}};
}

KeyAddress locate(const std::string& key, const Scene& scene, const std::string& where) {
  if (key.compare(0, component_prefix.size(), component_prefix) != 0) return {key, key, 0};
  const std::string address = key.substr(component_prefix.size());
  std::optional<Found> found = find_by_number(address, scene);
  if (!found) found = find_by_name(address, scene);
  if (!found) refuse_component(address, scene, where);
  const std::string rest = address.substr(found->address_length);
  return {"component" + rest, fmt::format("component.{}{}", found->component, rest),
          found->component};
}

}  // namespace splotchcl::scene_file
