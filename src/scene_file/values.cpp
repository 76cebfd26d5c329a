#include "scene_file/values.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <sstream>

#include "common/words.h"
#include "snapshot/field_names.h"

namespace splotchcl::scene_file {
namespace {

constexpr int largest_type = particle_type_limit - 1;

// Integers are numbers too: 45 and 45.0 mean the same, with any number of digits.
std::optional<double> read_number(const toml::node& node, const Range& range) {
  std::optional<double> value = node.value_exact<double>();
  if (const auto integer = node.value_exact<std::int64_t>()) {
    value = static_cast<double>(*integer);
  }
  if (!value || !range.contains(*value)) return std::nullopt;
  return value;
}

std::optional<int> read_integer(const toml::node& node, int at_least, int at_most) {
  const std::optional<std::int64_t> value = node.value_exact<std::int64_t>();
  if (!value || *value < at_least || *value > at_most) return std::nullopt;
  return static_cast<int>(*value);
}

std::optional<std::array<double, 3>> read_three_numbers(const toml::node& node,
                                                        const Range& range) {
  const toml::array* array = node.as_array();
  if (array == nullptr || array->size() != 3) return std::nullopt;
  std::array<double, 3> values;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::optional<double> value = read_number((*array)[i], range);
    if (!value) return std::nullopt;
    values[i] = *value;
  }
  return values;
}

std::optional<std::array<double, 2>> read_two_numbers(const toml::node& node, const Range& range) {
  const toml::array* array = node.as_array();
  if (array == nullptr || array->size() != 2) return std::nullopt;
  const std::optional<double> first = read_number((*array)[0], range);
  const std::optional<double> second = read_number((*array)[1], range);
  if (!first || !second) return std::nullopt;
  return std::array<double, 2>{*first, *second};
}

std::optional<std::vector<std::string>> read_texts(const toml::node& node) {
  const toml::array* array = node.as_array();
  if (array == nullptr) return std::nullopt;
  std::vector<std::string> texts;
  for (const toml::node& element : *array) {
    const std::optional<std::string> text = element.value_exact<std::string>();
    if (!text || text->empty()) return std::nullopt;
    texts.push_back(*text);
  }
  return texts;
}

std::string write_texts(const std::vector<std::string>& texts) {
  std::vector<std::string> quoted;
  for (const std::string& text : texts)
    quoted.push_back(write_text(text));
  return fmt::format("[{}]", fmt::join(quoted, ", "));
}

template <class Three>
std::string write_three_numbers(const Three& values) {
  return fmt::format("[{}, {}, {}]", write_number(values[0]), write_number(values[1]),
                     write_number(values[2]));
}

std::optional<int> read_particle_type(const toml::node& node) {
  const std::optional<std::string> name = node.value_exact<std::string>();
  if (!name) return read_integer(node, 0, largest_type);
  return find_particle_type(*name);
}

// "1920x1080".
std::optional<std::pair<int, int>> read_size(const std::string& text, int at_most) {
  const auto read = [at_most](std::string_view digits) -> std::optional<int> {
    int number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    const bool is_number = error == std::errc() && end == digits.data() + digits.size();
    return is_number && number >= 1 && number <= at_most ? std::optional(number) : std::nullopt;
  };
  const std::size_t cross = text.find('x');
  if (cross == std::string::npos) return std::nullopt;
  const auto width = read(std::string_view(text).substr(0, cross));
  const auto height = read(std::string_view(text).substr(cross + 1));
  return width && height ? std::optional(std::pair(*width, *height)) : std::nullopt;
}

// One type, or an array of different ones.
std::optional<std::vector<int>> read_particle_types(const toml::node& node) {
  const toml::array* array = node.as_array();
  if (array == nullptr) {
    const std::optional<int> type = read_particle_type(node);
    if (!type) return std::nullopt;
    return std::vector<int>{*type};
  }
  std::vector<int> types;
  for (const toml::node& element : *array) {
    const std::optional<int> type = read_particle_type(element);
    const bool is_twice = type && std::find(types.begin(), types.end(), *type) != types.end();
    if (!type || is_twice) return std::nullopt;
    types.push_back(*type);
  }
  if (types.empty()) return std::nullopt;
  return types;
}

std::string write_particle_types(const std::vector<int>& types) {
  std::vector<std::string> words;
  for (const int type : types) {
    const bool has_name = type >= 0 && static_cast<std::size_t>(type) < particle_type_names.size();
    words.push_back(has_name ? write_text(particle_type_name(type)) : std::to_string(type));
  }
  return fmt::format("[{}]", fmt::join(words, ", "));
}

std::optional<Absorption> read_absorption(const toml::node& node) {
  if (const auto word = node.value_exact<std::string>()) {
    if (*word == "emission") return Absorption{Absorption::Kind::as_emission, 0};
    if (*word == "none") return Absorption{Absorption::Kind::none, 0};
    return std::nullopt;
  }
  Range not_negative;
  not_negative.at_least = 0;
  const std::optional<double> factor = read_number(node, not_negative);
  if (!factor) return std::nullopt;
  if (*factor == 0) return Absorption{Absorption::Kind::none, 0};
  return Absorption{Absorption::Kind::factor, *factor};
}

std::string write_absorption(const Absorption& value) {
  if (value.kind == Absorption::Kind::as_emission) return "\"emission\"";
  if (value.kind == Absorption::Kind::none) return "\"none\"";
  return write_number(value.factor);
}

}  // namespace

bool Range::contains(double value) const {
  return std::isfinite(value) && (!at_least || value >= *at_least) &&
         (!more_than || value > *more_than) && (!at_most || value <= *at_most) &&
         (!less_than || value < *less_than);
}

std::string Range::description() const {
  std::vector<std::string> limits;
  if (at_least) limits.push_back(fmt::format(">= {}", *at_least));
  if (more_than) limits.push_back(fmt::format("> {}", *more_than));
  if (at_most) limits.push_back(fmt::format("<= {}", *at_most));
  if (less_than) limits.push_back(fmt::format("< {}", *less_than));
  if (limits.empty()) return "a finite number";
  return fmt::format("a number {}", fmt::join(limits, " and "));
}

ValueType<double> number(const Range& range) {
  return {range.description(), [range](const toml::node& node) { return read_number(node, range); },
          write_number};
}

ValueType<int> integer(int at_least, int at_most) {
  return {fmt::format("an integer from {} to {}", at_least, at_most),
          [=](const toml::node& node) { return read_integer(node, at_least, at_most); },
          [](const int& value) { return std::to_string(value); }};
}

ValueType<std::uint64_t> identifier() {
  const auto read = [](const toml::node& node) -> std::optional<std::uint64_t> {
    if (const auto number = node.value_exact<std::int64_t>())
      return *number < 0 ? std::nullopt : std::optional(static_cast<std::uint64_t>(*number));
    const auto text = node.value_exact<std::string>();
    return text ? parse_whole_number(*text) : std::nullopt;
  };
  const auto write = [](const std::uint64_t& number) {
    const std::string digits = std::to_string(number);
    return number > INT64_MAX ? '"' + digits + '"' : digits;
  };
  return {"a whole number from 0 to 2^64 - 1, beyond 2^63 - 1 as a string", read, write};
}

ValueType<int> bits(std::vector<int> numbers) {
  return {fmt::format("{}", fmt::join(numbers, " or ")),
          [numbers](const toml::node& node) -> std::optional<int> {
            const auto value = node.value_exact<std::int64_t>();
            for (const int number : numbers) {
              if (value == number) return number;
            }
            return std::nullopt;
          },
          [](const int& value) { return std::to_string(value); }};
}

ValueType<bool> boolean() {
  return {"true or false", [](const toml::node& node) { return node.value_exact<bool>(); },
          [](const bool& value) { return std::string(value ? "true" : "false"); }};
}

ValueType<std::vector<std::string>> texts() {
  return {"an array of strings that are not empty", read_texts, write_texts};
}

ValueType<std::array<double, 2>> two_numbers(const Range& range, const std::string& order) {
  return {fmt::format("{}, each {}", order, range.description()),
          [range](const toml::node& node) { return read_two_numbers(node, range); },
          [](const std::array<double, 2>& values) {
            return fmt::format("[{}, {}]", write_number(values[0]), write_number(values[1]));
          }};
}

ValueType<std::string> text() {
  const auto read = [](const toml::node& node) -> std::optional<std::string> {
    const std::optional<std::string> value = node.value_exact<std::string>();
    return value && !value->empty() ? value : std::nullopt;
  };
  return {"a string that is not empty", read, write_text};
}

ValueType<std::string> words(std::size_t most_bytes, std::size_t most_lines) {
  const auto read = [=](const toml::node& node) -> std::optional<std::string> {
    const std::optional<std::string> value = node.value_exact<std::string>();
    if (!value || value->empty() || value->size() > most_bytes) return std::nullopt;
    const auto breaks = std::count(value->begin(), value->end(), '\n');
    return static_cast<std::size_t>(breaks) < most_lines ? value : std::nullopt;
  };
  return {fmt::format("a string that is not empty, of at most {} bytes and {} lines", most_bytes,
                      most_lines),
          read, write_text};
}

ValueType<std::array<double, 3>> three_numbers(const Range& range, const std::string& order) {
  return {fmt::format("{}, each {}", order, range.description()),
          [range](const toml::node& node) { return read_three_numbers(node, range); },
          write_three_numbers<std::array<double, 3>>};
}

ValueType<Vec3> vector() {
  const auto read = [](const toml::node& node) -> std::optional<Vec3> {
    const auto values = read_three_numbers(node, {});
    if (!values) return std::nullopt;
    return std::make_optional(Vec3{{(*values)[0], (*values)[1], (*values)[2]}});
  };
  return {"[x, y, z], each a finite number", read,
          [](const Vec3& value) { return write_three_numbers(value.a); }};
}

ValueType<std::pair<int, int>> size_in_pixels(int at_most) {
  const auto read = [at_most](const toml::node& node) -> std::optional<std::pair<int, int>> {
    if (const auto text = node.value_exact<std::string>()) return read_size(*text, at_most);
    const toml::array* array = node.as_array();
    if (array == nullptr || array->size() != 2) return std::nullopt;
    const std::optional<int> width = read_integer((*array)[0], 1, at_most);
    const std::optional<int> height = read_integer((*array)[1], 1, at_most);
    if (!width || !height) return std::nullopt;
    return std::pair(*width, *height);
  };
  const auto write = [](const std::pair<int, int>& size) {
    return fmt::format("[{}, {}]", size.first, size.second);
  };
  return {fmt::format("[width, height] or \"WIDTHxHEIGHT\", each an integer from 1 to {}", at_most),
          read, write};
}

ValueType<std::vector<int>> particle_types() {
  return {fmt::format("a particle type or an array of different ones, each a number from 0 to {} "
                      "or one of {} (or star, dm, dark_matter, PartType1, ...)",
                      largest_type, fmt::join(particle_type_names, ", ")),
          read_particle_types, write_particle_types};
}

namespace {

using TwoNumbers = std::array<double, 2>;

// Two of a range that rise.
ValueType<TwoNumbers> rising_pair(const Range& range, const std::string& expected) {
  const auto read = [range](const toml::node& node) -> std::optional<TwoNumbers> {
    const toml::array* const array = node.as_array();
    if (array == nullptr || array->size() != 2) return std::nullopt;
    const auto low = number(range).read((*array)[0]);
    const auto high = number(range).read((*array)[1]);
    if (!low || !high || !(*low < *high)) return std::nullopt;
    return TwoNumbers{*low, *high};
  };
  return {expected, read, [](const TwoNumbers& value) {
            return "[" + write_number(value[0]) + ", " + write_number(value[1]) + "]";
          }};
}

}  // namespace

ValueType<TwoNumbers> percentiles() {
  Range range;
  range.at_least = 0;
  range.at_most = 100;
  return rising_pair(range, "[low, high], numbers from 0 to 100 with low < high");
}

ValueType<TwoNumbers> from_to() {
  Range range;
  range.at_least = 0;
  return rising_pair(range, "[from, to], numbers >= 0 with from < to");
}

ValueType<Absorption> absorption() {
  return {"\"emission\" or \"none\" or a number >= 0", read_absorption, write_absorption};
}

std::string write_number(double value) {
  // As an integer, which is what "-0" is in TOML, it would lose its sign.
  if (value == 0 && std::signbit(value)) return "-0.0";
  return fmt::format("{}", value);
}

std::string write_text(const std::string& value) {
  require_utf8(value);
  std::string quoted = "\"";
  for (const Character& character : characters_of(value)) {
    if (character.bytes == "\"" || character.bytes == "\\") quoted += '\\';
    if (is_control(*character.code)) {
      quoted += fmt::format("\\u{:04X}", static_cast<unsigned>(*character.code));
    } else {
      quoted += character.bytes;
    }
  }
  return quoted + "\"";
}

std::string one_line(const std::string& text, std::size_t longest) {
  std::string line;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    const bool continues_a_letter = (code & 0xc0) == 0x80;  // of UTF-8
    if (line.size() >= longest && !continues_a_letter) return line + "...";
    const char shown = code < 0x20 || code == 0x7f ? ' ' : c;
    const bool is_spare = shown == ' ' && !line.empty() && line.back() == ' ';
    if (!is_spare) line += shown;
  }
  return line;
}

std::string describe(const toml::node& node) {
  std::ostringstream value;
  node.visit([&value](const auto& typed) {
    if constexpr (toml::is_string<decltype(typed)>) {
      value << '"' << typed.get() << '"';
    } else if constexpr (toml::is_table<decltype(typed)>) {
      value << (typed.empty() ? "without keys" : "with keys");
    } else {
      value << typed;
    }
  });
  std::ostringstream type;
  type << node.type();
  return type.str() + " " + one_line(value.str());
}

}  // namespace splotchcl::scene_file
