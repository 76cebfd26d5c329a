#include "scene_file/setting.h"

#include <fmt/format.h>

#include <cctype>
#include <cstddef>
#include <optional>
#include <sstream>
#include <vector>

#include "common/words.h"
#include "scene_file/check.h"
#include "scene_file/keys.h"
#include "scene_file/values.h"
#include "splotchcl/error.h"

namespace splotchcl::scene_file {
namespace {

constexpr int most_parts = 16;

// Goes through a text from string to string and from remark to remark.
class Scanner {
 public:
  explicit Scanner(const std::string& text) : text_(text) {}

  int find_deep_key() {
    while (at_ < text_.size()) {
      step();
      if (parts_ > most_parts) return line_;
    }
    return 0;
  }

 private:
  void step() {
    const char c = text_[at_];
    if (c == '"' || c == '\'') {
      skip_string(c);
    } else if (c == '#') {
      while (at_ < text_.size() && text_[at_] != '\n')
        ++at_;
    } else {
      take(c);
      ++at_;
    }
  }

  // Names, and blanks around dots, go on with a key; all else ends it.
  void take(char c) {
    if (c == '\n') ++line_;
    if (c == '.') {
      ++parts_;
    } else if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_' && c != '-' &&
               c != ' ' && c != '\t') {
      parts_ = 1;
    }
  }

  bool is_triple(char quote) const { return text_.compare(at_, 3, std::string(3, quote)) == 0; }

  // As a part of a key, if it is one.
  void skip_string(char quote) {
    const bool has_lines = is_triple(quote);
    at_ += has_lines ? 3 : 1;
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '\n') {
        if (!has_lines) return;
        ++line_;
      }
      if (c == quote && (!has_lines || is_triple(quote))) {
        at_ += has_lines ? 3 : 1;
        return;
      }
      at_ += c == '\\' && quote == '"' ? 2 : 1;
    }
  }

  const std::string& text_;
  std::size_t at_ = 0;
  int line_ = 1, parts_ = 1;
};

}  // namespace

int find_deep_key(const std::string& text) {
  return Scanner(text).find_deep_key();
}

// Twice before it is none: the parser reads numbers from a stream, which takes memory that it does
// not get for a number that it cannot read.
toml::table parse_toml(const std::string& text) {
  try {
    return toml::parse(text);
  } catch (const toml::parse_error&) {
    return toml::parse(text);
  }
}

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

namespace {

// Numbers, or a list of them, as people write them: TOML wants digits on both sides of a point,
// 0.5 for .5 and 1.0 for 1. - other texts stay.
std::string with_digits_around_points(const std::string& text) {
  if (text.find_first_not_of("0123456789.,+-eE[] \t") != std::string::npos) return text;
  const auto is_digit = [&text](std::size_t i) {
    return i < text.size() && text[i] >= '0' && text[i] <= '9';
  };
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool is_point = text[i] == '.';
    const bool is_after_digit = i > 0 && is_digit(i - 1), is_before_digit = is_digit(i + 1);
    if (is_point && !is_after_digit && !is_before_digit) return text;
    if (is_point && !is_after_digit) result += '0';
    result += text[i];
    if (is_point && !is_before_digit) result += '0';
  }
  return result;
}

std::optional<toml::table> parse_as_toml(const std::string& text) {
  try {
    toml::table table = parse_toml("value = " + text);
    if (table.size() == 1 && table.contains("value")) return table;
  } catch (const toml::parse_error&) {
    // A bare word: palette=magma.
  }
  return std::nullopt;
}

}  // namespace

toml::table parse_value(const std::string& text) {
  if (find_deep_key(text) > 0) return toml::table{{"value", text}};
  std::optional<toml::table> table = parse_as_toml(text);
  if (!table) table = parse_as_toml(with_digits_around_points(text));
  return table ? std::move(*table) : toml::table{{"value", text}};
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
