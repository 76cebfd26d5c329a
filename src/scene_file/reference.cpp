#include <fmt/format.h>

#include <map>
#include <string>

#include "formula/selection.h"
#include "scene_file/keys.h"

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
  std::string value = found == shorter.end() ? key.expected : found->second;
  const std::string between_words = "\" or \"";
  for (std::size_t at = value.find(between_words); at != std::string::npos;
       at = value.find(between_words, at)) {
    value.replace(at, between_words.size(), "\", \"");
  }
  return key.unit.empty() ? value : value + "; " + key.unit;
}

// Names of pages become links.
std::string with_links(std::string text) {
  const std::string ending = ".md";
  for (std::size_t end = text.find(ending); end != std::string::npos;
       end = text.find(ending, end)) {
    const std::size_t begin = text.find_last_of(" (", end) + 1;
    const std::string page = text.substr(begin, end + ending.size() - begin);
    const std::string link = "[" + page + "](" + page + ")";
    text.replace(begin, page.size(), link);
    end = begin + link.size();
  }
  return text;
}

std::string row(const Key& key, const std::string& name) {
  return fmt::format("| `{}` | {} | {} | {} |\n", name, value_of(key), with_links(default_of(key)),
                     with_links(key.meaning));
}

// Keys that are like others but for their meaning share a row.
struct Family {
  std::string stem, model, meaning;
};

const Family* family_of(const std::string& path) {
  static const Family families[] = {
      {"component.exclude", "select", "Particles that fulfil all of these are left out."},
      {"component.intensity", "color",
       "A field that becomes I, a factor on emission and absorption."},
      {"finish.label", "title", "Another text, at the top right."},
      {"finish.caption", "title", "A third text, at the bottom right."},
  };
  for (const Family& family : families)
    if (path.rfind(family.stem + ".", 0) == 0) return &family;
  return nullptr;
}

std::string row(const Family& family) {
  std::string names;
  for (const Key& key : all_keys()) {
    if (family_of(key.path) != &family) continue;
    const std::string name = key.path.substr(family.stem.size());
    names += names.empty() ? "`" + family.stem.substr(family.stem.find('.') + 1) + name + "`"
                           : ", `" + name + "`";
  }
  return fmt::format("| {} | as `{}.*` | not used | {} |\n", names, family.model, family.meaning);
}

std::string rows_of_table(const std::string& table) {
  std::string text;
  const Family* last = nullptr;
  for (const Key& key : all_keys()) {
    const std::size_t dot = key.path.find('.');
    const std::string key_table = dot == std::string::npos ? "" : key.path.substr(0, dot);
    if (key_table != table) continue;
    const Family* const family = family_of(key.path);
    if (family == nullptr)
      text += row(key, key.path.substr(dot == std::string::npos ? 0 : dot + 1));
    if (family != nullptr && family != last) text += row(*family);
    last = family;
  }
  return text;
}

}  // namespace

std::string key_reference() {
  std::string text;
  for (const std::string table : {"", "read", "image", "camera", "stereo", "kernel", "sort", "time",
                                  "path", "movie", "periodic", "finish", "map", "component"}) {
    text += fmt::format("### {}\n\n| key | value | default | meaning |\n|---|---|---|---|\n",
                        heading(table));
    text += rows_of_table(table) + "\n";
  }
  return text;
}

}  // namespace splotchcl::scene_file
