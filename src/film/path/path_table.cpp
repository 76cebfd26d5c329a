#include "film/path/path_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <utility>

#include "common/mapped_file.h"
#include "common/words.h"
#include "scene/scalar_map.h"
#include "scene_file/keys.h"
#include "scene_file/setting.h"
#include "scene_file/values.h"
#include "splotchcl/error.h"

namespace splotchcl {

std::vector<std::string> path_words(std::string line) {
  line = line.substr(0, line.find('#'));
  std::replace(line.begin(), line.end(), ',', ' ');
  std::istringstream words(line);
  std::vector<std::string> result;
  for (std::string word; words >> word;)
    result.push_back(word);
  return result;
}

bool is_path_header(const std::vector<std::string>& words) {
  return !std::all_of(words.begin(), words.end(),
                      [](const std::string& word) { return parse_number(word).has_value(); });
}

const std::vector<std::string>& path_columns_without_header() {
  static const std::vector<std::string> names = {"camera_x", "camera_y", "camera_z", "lookat_x",
                                                 "lookat_y", "lookat_z", "sky_x",    "sky_y",
                                                 "sky_z",    "fidx"};
  return names;
}

std::map<std::string, double> first_path_row(const std::string& text) {
  std::istringstream lines(text);
  std::vector<std::string> names;
  for (std::string line; std::getline(lines, line);) {
    const std::vector<std::string> words = path_words(line);
    if (words.empty()) continue;
    if (names.empty() && is_path_header(words)) {
      names = words;
      continue;
    }
    if (names.empty()) names = path_columns_without_header();
    std::map<std::string, double> row;
    for (std::size_t i = 0; i < std::min(names.size(), words.size()); ++i) {
      if (const std::optional<double> value = parse_number(words[i])) row[names[i]] = *value;
    }
    return row;
  }
  return {};
}

namespace {

using scene_file::one_line;
using scene_file::write_number;
using scene_file::write_text;

// A value of the file as TOML. Words are left to the key, which knows what it takes, but for
// names of files, which stand relative to the file.
std::optional<std::string> read_value(const std::string& word, const PathColumn& column,
                                      const std::filesystem::path& folder) {
  std::optional<double> number = parse_number(word);
  if (!number) {
    if (column.axis || column.undo || column.factor != 1) return std::nullopt;
    return scene_file::with_file_name(
        column.path, word, [&folder](const std::string& name) { return (folder / name).string(); });
  }
  if (column.undo) number = unscaled(*number, *column.undo);
  *number *= column.factor;
  if (!std::isfinite(*number)) return std::nullopt;
  return write_number(*number);
}

}  // namespace

PathTable::PathTable(const std::filesystem::path& path, const Scene& scene) : path_(path) {
  read_text(read_text_file(path), scene);
}

void PathTable::read_text(const std::string& text, const Scene& scene) {
  std::istringstream lines(text);
  int line = 0;
  for (std::string content; std::getline(lines, content);) {
    ++line;
    const std::vector<std::string> words = path_words(content);
    if (words.empty()) continue;
    const bool is_first = columns_.empty();
    const bool is_header = is_first && is_path_header(words);
    if (is_first)
      read_header(is_header ? words : std::vector<std::string>(words.size()), line, scene);
    if (!is_header) rows_.push_back(read_row(words, line));
  }
  if (rows_.empty()) {
    throw UsageError(path_.string() + ": found no row of values, expected one for each frame");
  }
}

// Without names the words are empty.
void PathTable::read_header(const std::vector<std::string>& words, int line, const Scene& scene) {
  std::vector<std::string> names = words;
  if (names.front().empty()) {
    const std::vector<std::string>& expected = path_columns_without_header();
    const std::size_t full = expected.size();
    if (names.size() != full && names.size() + 1 != full) {
      throw UsageError(fmt::format(
          "{}: found {} columns and no line that names them, expected 9 (x, y and z of camera, "
          "look-at and sky), 10 (and the index of the snapshot), or a first line such as {}",
          at_line(line), names.size(), fmt::join(expected, " ")));
    }
    std::copy_n(expected.begin(), names.size(), names.begin());
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string where = fmt::format("{}: column {}", at_line(line), i + 1);
    columns_.push_back(find_path_column(names[i], scene, where));
  }
  check_columns(line);
}

void PathTable::check_columns(int line) const {
  std::map<std::string, std::set<std::size_t>> axes;
  std::set<std::string> whole;
  for (const PathColumn& column : columns_) {
    const bool is_new = column.axis ? axes[column.label].insert(*column.axis).second
                                    : whole.insert(column.label).second;
    if (is_new && !(column.axis && whole.count(column.label) > 0)) continue;
    throw UsageError(fmt::format("{}: found a second column for {}, {}, expected one",
                                 at_line(line), column.label, write_text(column.name)));
  }
  for (const auto& [label, found] : axes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (found.count(axis) > 0) continue;
      throw UsageError(fmt::format("{}: found {} of the 3 columns of {}, expected {}.{} as well",
                                   at_line(line), found.size(), label, label, "xyz"[axis]));
    }
  }
}

PathTable::Row PathTable::read_row(const std::vector<std::string>& words, int line) const {
  if (words.size() != columns_.size()) {
    std::vector<std::string> names;
    for (const PathColumn& column : columns_)
      names.push_back(column.name);
    throw UsageError(fmt::format("{}: found {} values, expected {}, one for each of {}",
                                 at_line(line), words.size(), columns_.size(),
                                 fmt::join(names, " ")));
  }
  Row row = {line, {}};
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::optional<std::string> value = read_value(words[i], columns_[i], path_.parent_path());
    if (!value) {
      throw UsageError(fmt::format("{}: column {} ({}): found {}, expected a finite number",
                                   at_line(line), i + 1, columns_[i].name,
                                   write_text(one_line(words[i]))));
    }
    row.values.push_back(*value);
  }
  return row;
}

std::vector<std::string> PathTable::settings(int row) const {
  const Row& from = rows_.at(static_cast<std::size_t>(row));
  std::vector<std::string> settings;
  std::map<std::string, std::array<std::string, 3>> vectors;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const PathColumn& column = columns_[i];
    if (column.key.empty()) continue;
    if (column.axis) {
      vectors[column.key][*column.axis] = from.values[i];
    } else {
      settings.push_back(column.key + "=" + from.values[i]);
    }
  }
  for (const auto& [key, values] : vectors)
    settings.push_back(fmt::format("{}=[{}]", key, fmt::join(values, ", ")));
  return settings;
}

std::string PathTable::where(int row, const std::string& label) const {
  const std::string line = at_line(rows_.at(static_cast<std::size_t>(row)).line);
  std::vector<std::string> numbers, names;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (columns_[i].label != label) continue;
    numbers.push_back(std::to_string(i + 1));
    names.push_back(columns_[i].name);
  }
  if (names.empty()) return line;
  return fmt::format("{}: column{} {} ({})", line, names.size() > 1 ? "s" : "",
                     fmt::join(numbers, ", "), fmt::join(names, ", "));
}

bool PathTable::sets(const std::string& key) const {
  return std::any_of(columns_.begin(), columns_.end(),
                     [&key](const PathColumn& column) { return column.key == key; });
}

void PathTable::drop(const std::string& key) {
  for (PathColumn& column : columns_) {
    if (column.key == key) column.key.clear();
  }
}

bool PathTable::is_constant(const std::string& key) const {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (columns_[i].key != key) continue;
    const bool is_same = std::all_of(rows_.begin(), rows_.end(), [&](const Row& row) {
      return row.values[i] == rows_.front().values[i];
    });
    if (!is_same) return false;
  }
  return true;
}

std::string PathTable::at_line(int line) const {
  return fmt::format("{}:{}", path_.string(), line);
}

namespace {

using scene_file::find_key;
using scene_file::one_line;

// The original program's names for what does not depend on a component.
const std::map<std::string, std::string>& original_names() {
  static const std::map<std::string, std::string> names = {
      {"camera_x", "camera.position.x"},
      {"camera_y", "camera.position.y"},
      {"camera_z", "camera.position.z"},
      {"lookat_x", "camera.look_at.x"},
      {"lookat_y", "camera.look_at.y"},
      {"lookat_z", "camera.look_at.z"},
      {"sky_x", "camera.sky.x"},
      {"sky_y", "camera.sky.y"},
      {"sky_z", "camera.sky.z"},
      {"fov", "camera.field_of_view"},
      {"zmin", "camera.near"},
      {"zmax", "camera.far"},
      {"minrad_pix", "kernel.min_radius"},
      {"fidx", "time.index"},
  };
  return names;
}

// Those that end with a component's number.
const std::map<std::string, std::string>& original_component_names() {
  static const std::map<std::string, std::string> names = {
      {"brightness", "brightness"},       {"size_fac", "size.factor"},
      {"size_fix", "size.fixed"},         {"color_min", "color.min"},
      {"color_max", "color.max"},         {"intensity_min", "intensity.min"},
      {"intensity_max", "intensity.max"}, {"palette", "palette"},
  };
  return names;
}

bool is_digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

// "brightness0" is component.0.brightness. Other names are left as they are.
std::string without_original_names(const std::string& name) {
  const auto plain = original_names().find(name);
  if (plain != original_names().end()) return plain->second;
  const auto digits = std::find_if_not(name.rbegin(), name.rend(), is_digit).base();
  const auto found = original_component_names().find(std::string(name.begin(), digits));
  if (digits == name.end() || found == original_component_names().end()) return name;
  return "component." + std::string(digits, name.end()) + "." + found->second;
}

std::optional<std::size_t> axis_of(const std::string& word) {
  constexpr std::array<std::array<const char*, 3>, 4> words = {
      {{"x", "y", "z"}, {"0", "1", "2"}, {"r", "g", "b"}, {"red", "green", "blue"}}};
  for (const auto& three : words) {
    const auto found = std::find(three.begin(), three.end(), word);
    if (found != three.end()) return static_cast<std::size_t>(found - three.begin());
  }
  return std::nullopt;
}

// The key's address, if it is one.
std::optional<scene_file::KeyAddress> find_address(const std::string& key, const Scene& scene,
                                                   const std::string& where) {
  const scene_file::KeyAddress address = scene_file::locate(key, scene, where);
  return find_key(address.path) == nullptr ? std::nullopt : std::optional(address);
}

std::vector<std::string> all_names() {
  std::vector<std::string> names;
  for (const scene_file::Key& key : scene_file::all_keys()) {
    if (may_change_in_film(key.path)) names.push_back(key.path);
  }
  for (const auto& [name, key] : original_names())
    names.push_back(name);
  return names;
}

std::string list_names(const std::map<std::string, std::string>& names) {
  std::string list;
  for (const auto& [name, key] : names)
    list += (list.empty() ? "" : ", ") + name;
  return list;
}

[[noreturn]] void refuse_column(const std::string& name, const std::string& where) {
  throw UsageError(fmt::format(
      "{}: found {}, expected a key of a scene file such as camera.field_of_view, a part of one "
      "such as camera.position.x, one of the original program's {}, or with a component's number "
      "one of {}{}",
      where, scene_file::write_text(one_line(name)), list_names(original_names()),
      list_names(original_component_names()), did_you_mean(nearest_name(name, all_names()))));
}

std::optional<Scaling> scaling_to_undo(const scene_file::KeyAddress& address, const Scene& scene) {
  const bool is_color = address.path.rfind("component.color.", 0) == 0;
  const Component& component = scene.components.at(address.component);
  return (is_color ? component.color : component.intensity).scaling;
}

}  // namespace

bool may_change_in_film(const std::string& path) {
  const std::string table = path.substr(0, path.find('.'));
  return table != "path" && table != "movie" && table != "map" && table != "read" &&
         path != "image.size" && path != "image.width" && path != "image.height" &&
         path != "component.name";
}

void check_may_change(const std::string& path, const std::string& name, const std::string& where) {
  if (may_change_in_film(path)) return;
  const bool is_of_reading = path.rfind("read.", 0) == 0;
  throw UsageError(fmt::format(
      "{}: found {}, expected keys that may change within a film{}", where, one_line(name),
      is_of_reading ? "; its data is read once: set the key for the whole film" : ""));
}

PathColumn find_path_column(const std::string& name, const Scene& scene, const std::string& where) {
  const std::string key = without_original_names(name);
  PathColumn column;
  column.name = name;
  column.key = key;
  std::optional<scene_file::KeyAddress> address = find_address(key, scene, where);
  if (!address) {
    const std::size_t dot = key.rfind('.');
    column.axis = dot == std::string::npos ? std::nullopt : axis_of(key.substr(dot + 1));
    if (column.axis) {
      column.key = key.substr(0, dot);
      address = find_address(column.key, scene, where);
    }
  }
  if (!address) refuse_column(name, where);
  check_may_change(address->path, name, where);
  column.path = address->path;
  column.label = address->label;
  // The original's is of r = 2 h.
  if (name == "minrad_pix") column.factor = 0.5;
  const std::string last = address->path.substr(address->path.rfind('.') + 1);
  const bool is_range = last == "min" || last == "max";
  if (key != name && is_range) column.undo = scaling_to_undo(*address, scene);
  return column;
}

}  // namespace splotchcl
