#include "scene_file/unknown_key.h"

#include <fmt/format.h>

#include <optional>
#include <sstream>
#include <vector>

#include "common/nearest_name.h"
#include "scene_file/check.h"
#include "scene_file/keys.h"
#include "scene_file/values.h"

namespace splotchcl::scene_file {
namespace {

std::string last_name(const std::string& path) {
  return path.substr(path.rfind('.') + 1);
}

// The name of which this is nearly a word: field_of_view of "feild". Short words are like too much.
std::optional<std::string> name_with_word(const std::string& word,
                                          const std::vector<std::string>& names) {
  constexpr std::size_t short_word = 3;
  std::vector<std::string> words;
  std::vector<std::string> owners;
  for (const std::string& name : names) {
    std::istringstream parts(name);
    for (std::string part; std::getline(parts, part, '_');) {
      if (part.size() <= short_word || part == name) continue;
      words.push_back(part);
      owners.push_back(name);
    }
  }
  const std::optional<std::string> nearest = nearest_name(word, words);
  for (std::size_t i = 0; nearest && i < words.size(); ++i) {
    if (words[i] == *nearest) return owners[i];
  }
  return std::nullopt;
}

// In the table, part by part of the name: "colour.feild" means "color.field".
std::optional<std::string> nearest_in_table(const std::string& table, const std::string& name) {
  const std::size_t dot = name.find('.');
  const std::string first = name.substr(0, dot);
  const std::vector<std::string> known = names_in_table(table);
  std::optional<std::string> nearest = nearest_name(first, known);
  if (!nearest) nearest = name_with_word(first, known);
  if (!nearest || dot == std::string::npos) return nearest;
  const auto rest = nearest_in_table(join(table, *nearest), name.substr(dot + 1));
  return rest ? join(*nearest, *rest) : nearest;
}

// In any table within this one: a key that has this name, or nearly; with dots from there on.
std::optional<std::string> nearest_within(const std::string& table, const std::string& name) {
  const std::string start = table.empty() ? "" : table + ".";
  std::vector<std::string> paths, names;
  for (const Key& key : all_keys()) {
    if (key.path.compare(0, start.size(), start) != 0) continue;
    paths.push_back(key.path.substr(start.size()));
    names.push_back(last_name(key.path));
  }
  const std::optional<std::string> nearest = nearest_name(last_name(name), names);
  for (std::size_t i = 0; nearest && i < names.size(); ++i) {
    if (names[i] == *nearest) return paths[i];
  }
  return std::nullopt;
}

// As the user writes it: keys of components have a number there.
std::string with_number(const std::string& path) {
  const std::string start = "component.";
  return path.compare(0, start.size(), start) == 0 ? start + "0." + path.substr(start.size())
                                                   : path;
}

std::optional<std::string> nearest_key(const KeyAddress& table, const std::string& name) {
  std::optional<std::string> nearest = nearest_in_table(table.path, name);
  if (!nearest) nearest = nearest_within(table.path, name);
  if (nearest && !table.path.empty()) return join(table.label, *nearest);
  if (!nearest) nearest = nearest_within("", name);
  return nearest ? std::optional(with_number(*nearest)) : std::nullopt;
}

}  // namespace

std::string join(const std::string& table, const std::string& name) {
  return table.empty() ? name : table + "." + name;
}

void refuse_unknown_key(const KeyAddress& table, const std::string& name,
                        const std::string& where) {
  const std::vector<std::string> known = names_in_table(table.path);
  refuse(where, one_line(join(table.label, name)), "an unknown key",
         fmt::format("one of {}", fmt::join(known, ", ")), did_you_mean(nearest_key(table, name)));
}

}  // namespace splotchcl::scene_file
