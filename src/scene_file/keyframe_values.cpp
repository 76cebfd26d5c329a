#include "scene_file/keyframe_values.h"

#include <fmt/format.h>

#include <optional>
#include <string>

namespace splotchcl::scene_file {
namespace {

// A value as text that reads back as the same; nothing for dates, which no key takes.
std::optional<std::string> write_value(const toml::node& node) {
  if (const auto text = node.value_exact<std::string>()) return write_text(*text);
  if (const auto number = node.value_exact<double>()) return write_number(*number);
  if (const auto integer = node.value_exact<std::int64_t>()) return std::to_string(*integer);
  if (const auto flag = node.value_exact<bool>()) return *flag ? "true" : "false";
  const toml::array* array = node.as_array();
  if (array == nullptr) return std::nullopt;
  std::vector<std::string> elements;
  for (const toml::node& element : *array) {
    const std::optional<std::string> text = write_value(element);
    if (!text) return std::nullopt;
    elements.push_back(*text);
  }
  return fmt::format("[{}]", fmt::join(elements, ", "));
}

// The camera's vectors may be written without its name.
std::string full_key(const std::string& key) {
  const bool is_short = key == "position" || key == "look_at" || key == "sky";
  return is_short ? "camera." + key : key;
}

// Keys and those of tables in the table, with dots. False: a value that no key takes, or a
// key for the second time.
bool collect(const toml::table& table, const std::string& prefix,
             std::map<std::string, std::string>& values) {
  for (const auto& [name, node] : table) {
    const std::string key = prefix + std::string(name.str());
    if (key == "frame") continue;
    if (const toml::table* inner = node.as_table()) {
      if (!collect(*inner, key + ".", values)) return false;
      continue;
    }
    const std::optional<std::string> value = write_value(node);
    if (!value || !values.emplace(full_key(key), *value).second) return false;
  }
  return true;
}

std::optional<Keyframe> read_keyframe(const toml::node& node) {
  const toml::table* table = node.as_table();
  if (table == nullptr) return std::nullopt;
  const toml::node* frame = table->get("frame");
  if (frame == nullptr) return std::nullopt;
  Range range;
  range.at_least = 0;
  const std::optional<double> place = number(range).read(*frame);
  Keyframe keyframe;
  if (!place || !collect(*table, "", keyframe.values) || keyframe.values.empty()) {
    return std::nullopt;
  }
  keyframe.frame = *place;
  return keyframe;
}

std::optional<std::vector<Keyframe>> read_keyframes(const toml::node& node) {
  const toml::array* array = node.as_array();
  if (array == nullptr || array->empty()) return std::nullopt;
  std::vector<Keyframe> keyframes;
  for (const toml::node& element : *array) {
    const std::optional<Keyframe> keyframe = read_keyframe(element);
    const bool is_in_order =
        keyframe && (keyframes.empty() || keyframes.back().frame < keyframe->frame);
    if (!is_in_order) return std::nullopt;
    keyframes.push_back(*keyframe);
  }
  return keyframes;
}

std::string write_keyframes(const std::vector<Keyframe>& keyframes) {
  std::vector<std::string> tables;
  for (const Keyframe& keyframe : keyframes) {
    std::string table = "frame = " + write_number(keyframe.frame);
    for (const auto& [key, value] : keyframe.values)
      table += fmt::format(", {} = {}", write_text(key), value);
    tables.push_back(fmt::format("  {{ {} }},\n", table));
  }
  return fmt::format("[\n{}]", fmt::join(tables, ""));
}

std::optional<std::vector<Vec3>> read_points(const toml::node& node) {
  const toml::array* array = node.as_array();
  if (array == nullptr || array->size() < 2) return std::nullopt;
  std::vector<Vec3> points;
  for (const toml::node& element : *array) {
    const std::optional<Vec3> point = vector().read(element);
    if (!point) return std::nullopt;
    points.push_back(*point);
  }
  return points;
}

std::string write_points(const std::vector<Vec3>& points) {
  std::vector<std::string> texts;
  for (const Vec3& point : points)
    texts.push_back(vector().write(point));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

}  // namespace

ValueType<std::vector<Keyframe>> keyframes() {
  return {
      "tables in increasing order of frame, each with frame, a number >= 0, and one or more keys "
      "of a scene",
      read_keyframes, write_keyframes};
}

ValueType<std::vector<Vec3>> points() {
  return {"two or more of [x, y, z], each a finite number", read_points, write_points};
}

}  // namespace splotchcl::scene_file
