#include <fmt/format.h>

#include <map>
#include <string>

#include "scene_file/keys.h"
#include "select/condition.h"

namespace splotchcl::scene_file {
namespace {

// A scene with every part, all by default.
Scene default_scene() {
  Scene scene;
  scene.camera.emplace();
  scene.stereo.emplace();
  scene.components.emplace_back();
  return scene;
}

std::string default_of(const Key& key) {
  if (!key.absent.empty()) return key.absent;
  const auto value = key.get(default_scene(), 0);
  return value ? "`" + *value + "`" : "";
}

std::string heading(const std::string& table) {
  if (table.empty()) return "top level";
  return table == "component" ? "`[[component]]`, once for each kind of matter"
                              : "`[" + table + "]`";
}

// Errors tell all of what is expected; the page says once what holds for all keys.
std::string value_of(const Key& key) {
  static const std::map<std::string, std::string> shorter = {
      {"a string that is not empty", "a string"},
      {"an array of strings that are not empty", "an array of strings"},
      {"a finite number", "a number"},
      {"an array of finite numbers", "an array of numbers"},
      {"[x, y, z], each a finite number", "[x, y, z]"},
      {"two or more of [x, y, z], each a finite number", "an array of [x, y, z]"},
      {condition_form, "a condition, or an array of them"},
      {find_key("finish.title.at")->expected, "a place"},
  };
  const auto found = shorter.find(key.expected);
  const std::string value = found == shorter.end() ? key.expected : found->second;
  return key.unit.empty() ? value : value + "; " + key.unit;
}

std::string row(const Key& key, const std::string& name) {
  return fmt::format("| `{}` | {} | {} | {} |\n", name, value_of(key), default_of(key),
                     key.meaning);
}

}  // namespace

std::string key_reference() {
  std::string text;
  for (const std::string table : {"", "read", "image", "camera", "stereo", "kernel", "sort", "time",
                                  "path", "movie", "periodic", "finish", "map", "component"}) {
    text += fmt::format("### {}\n\n| key | value | default | meaning |\n|---|---|---|---|\n",
                        heading(table));
    for (const Key& key : all_keys()) {
      const std::size_t dot = key.path.find('.');
      const std::string key_table = dot == std::string::npos ? "" : key.path.substr(0, dot);
      if (key_table != table) continue;
      text += row(key, dot == std::string::npos ? key.path : key.path.substr(dot + 1));
    }
    text += "\n";
  }
  return text;
}

}  // namespace splotchcl::scene_file
