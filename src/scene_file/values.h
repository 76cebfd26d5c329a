#pragma once

#include <toml++/toml.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "splotchcl/scene.h"

// The types of values that keys of a scene file have: how each is read from TOML, how
// it is written, and how it is described to someone who got it wrong.
namespace splotchcl::scene_file {

template <class V>
struct ValueType {
  std::string expected;  // completes "expected ..."
  // Nothing: not of this type, or out of range.
  std::function<std::optional<V>(const toml::node&)> read;
  std::function<std::string(const V&)> write;  // as TOML
};

// A range of finite numbers. The limits themselves belong to it or not.
struct Range {
  std::optional<double> at_least, more_than, at_most, less_than;
  bool contains(double value) const;
  std::string description() const;  // "a finite number", "a number > 0", ...
};

ValueType<double> number(const Range& range = {});
ValueType<int> integer(int at_least, int at_most);
ValueType<std::uint64_t> identifier();          // a whole number, exact, beyond 2^63 as a string
ValueType<int> bits(std::vector<int> numbers);  // one of these
ValueType<bool> boolean();
ValueType<std::string> text();                                                 // not empty
ValueType<std::string> words(std::size_t most_bytes, std::size_t most_lines);  // not empty either
ValueType<std::vector<std::string>> texts();                                   // none of them empty
ValueType<std::array<double, 2>> two_numbers(const Range& range, const std::string& order);
ValueType<std::array<double, 3>> three_numbers(const Range& range, const std::string& order);
ValueType<Vec3> vector();
ValueType<std::pair<int, int>> size_in_pixels(int at_most);
ValueType<std::vector<int>> particle_types();
// [low, high] in per cent.
ValueType<std::array<double, 2>> percentiles();
ValueType<std::array<double, 2>> from_to();  // of distances
ValueType<Absorption> absorption();

// One of a few words.
template <class V>
ValueType<V> choice(std::vector<std::pair<std::string, V>> words) {
  std::string expected;
  for (const auto& [word, value] : words) {
    expected += (expected.empty() ? "\"" : " or \"") + word + "\"";
  }
  const auto read = [words](const toml::node& node) -> std::optional<V> {
    const std::optional<std::string> found = node.value_exact<std::string>();
    for (const auto& [word, value] : words) {
      if (found == word) return value;
    }
    return std::nullopt;
  };
  const auto write = [words](const V& wanted) -> std::string {
    for (const auto& [word, value] : words) {
      if (value == wanted) return "\"" + word + "\"";
    }
    return "";
  };
  return {expected, read, write};
}

// Shortest digits that read back as the same number.
std::string write_number(double value);
std::string write_text(const std::string& value);

// What was found, on one line and not too long: `string "abc"`, `integer 7`.
std::string describe(const toml::node& node);
std::string one_line(const std::string& text, std::size_t longest = 60);

}  // namespace splotchcl::scene_file
