#include "palette/palette_file.h"

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <charconv>
#include <cstddef>
#include <string_view>
#include <vector>

#include "splotchcl/error.h"

namespace splotchcl {
namespace {

constexpr std::string_view spaces = " \t\r\v\f";
constexpr std::string_view original_mark = "0100";

struct Line {
  std::string_view text;  // without spaces around it
  std::size_t number = 0;
};

[[noreturn]] void refuse(const std::string& name, std::size_t line, const std::string& problem) {
  throw DataError(fmt::format("{}:{}: {}", name, line, problem));
}

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(spaces);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(spaces) - begin + 1);
}

std::vector<Line> split_lines(std::string_view text) {
  std::vector<Line> lines;
  std::size_t number = 0;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    lines.push_back({trimmed(text.substr(0, end)), ++number});
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return lines;
}

std::string_view next_word(std::string_view& rest) {
  const std::size_t begin = rest.find_first_not_of(spaces);
  if (begin == std::string_view::npos) {
    rest = {};
    return {};
  }
  rest.remove_prefix(begin);
  const std::string_view word = rest.substr(0, rest.find_first_of(spaces));
  rest.remove_prefix(word.size());
  return word;
}

// The numbers of one line, each from 0 to `largest`.
std::vector<float> read_numbers(const Line& line, float largest, const std::string& name) {
  std::vector<float> numbers;
  std::string_view rest = line.text;
  for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest)) {
    float value = 0;
    const char* const end = word.data() + word.size();
    const auto result = fast_float::from_chars(word.data(), end, value);
    const bool is_number = result.ec == std::errc() && result.ptr == end;
    if (!is_number || !(value >= 0 && value <= largest)) {
      refuse(
          name, line.number,
          fmt::format("found \"{}\", expected a number from 0 to {}", word.substr(0, 40), largest));
    }
    numbers.push_back(value);
  }
  return numbers;
}

Rgb three_from(const std::vector<float>& numbers, std::size_t first) {
  return {numbers[first], numbers[first + 1], numbers[first + 2]};
}

// One knot per line, with or without absorption: the same on every line.
Palette read_knots(const std::vector<Line>& lines, const std::string& name) {
  Palette palette;
  palette.name = name;
  std::size_t columns = 0;
  for (const Line& line : lines) {
    if (line.text.empty() || line.text.front() == '#') continue;
    const std::vector<float> numbers = read_numbers(line, 1, name);
    if (columns == 0 && (numbers.size() == 3 || numbers.size() == 6)) columns = numbers.size();
    if (numbers.size() != columns) {
      const std::string expected =
          columns == 0 ? "3 (red, green, blue) or 6 (with absorption in red, green, blue)"
                       : fmt::format("{} as on the lines before", columns);
      refuse(name, line.number,
             fmt::format("found {} numbers, expected {}", numbers.size(), expected));
    }
    palette.emission.push_back(three_from(numbers, 0));
    if (columns == 6) palette.absorption.push_back(three_from(numbers, 3));
  }
  if (palette.emission.empty()) {
    throw DataError(name + ": found no knots, expected lines of 3 or 6 numbers from 0 to 1");
  }
  return palette;
}

bool is_original(const std::vector<Line>& lines) {
  return lines.size() >= 2 && lines[1].text == original_mark;
}

std::size_t read_knot_count(const std::vector<Line>& lines, const std::string& name) {
  std::size_t count = 0;
  if (lines.size() > 2) {
    const std::string_view text = lines[2].text;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), count);
    if (result.ec == std::errc() && result.ptr == text.data() + text.size() && count > 0) {
      return count;
    }
  }
  refuse(name, 3,
         fmt::format("found \"{}\", expected the number of knots",
                     lines.size() > 2 ? lines[2].text.substr(0, 40) : ""));
}

// A name, the mark, the number of knots, then as many lines of R G B from 0 to 255.
Palette read_original(const std::vector<Line>& lines, const std::string& name) {
  const std::size_t count = read_knot_count(lines, name);
  Palette palette;
  palette.name = name;
  for (std::size_t i = 3; i < lines.size(); ++i) {
    if (lines[i].text.empty()) continue;
    const std::vector<float> numbers = read_numbers(lines[i], 255, name);
    if (numbers.size() != 3) {
      refuse(name, lines[i].number,
             fmt::format("found {} numbers, expected 3: red, green, blue", numbers.size()));
    }
    const Rgb bytes = three_from(numbers, 0);
    palette.emission.push_back({bytes[0] / 255, bytes[1] / 255, bytes[2] / 255});
  }
  if (palette.emission.size() != count) {
    throw DataError(fmt::format("{}: found {} knots, expected {} as its third line says", name,
                                palette.emission.size(), count));
  }
  return palette;
}

}  // namespace

bool is_palette_path(const std::string& name) {
  return name.find_first_of("/.") != std::string::npos;
}

Palette parse_palette(const std::string& text, const std::string& name_for_messages) {
  const std::vector<Line> lines = split_lines(text);
  return is_original(lines) ? read_original(lines, name_for_messages)
                            : read_knots(lines, name_for_messages);
}

std::string palette_description(const std::string& text, const std::string& name) {
  const std::vector<Line> lines = split_lines(text);
  if (lines.empty()) return "";
  std::string_view first = lines.front().text;
  if (!is_original(lines)) {
    if (first.empty() || first.front() != '#') return "";
    first = trimmed(first.substr(1));
  }
  const std::string label = name + ":";
  if (first.substr(0, label.size()) == label) first = trimmed(first.substr(label.size()));
  return std::string(first);
}

}  // namespace splotchcl
