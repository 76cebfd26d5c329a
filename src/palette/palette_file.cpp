#include "palette/palette_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/words.h"
#include "splotchcl/error.h"
#include "splotchcl/palette.h"

namespace splotchcl {
namespace {

struct Knot {
  PaletteLine line;
  std::vector<std::string_view> words;
  std::vector<float> numbers;
};

bool is_comment(const PaletteLine& line) {
  return line.text.empty() || line.text.front() == '#';
}

// "#1f77b4", with or without the mark, and with an opacity that counts for nothing at ff.
std::optional<Rgb> color_of_letters(std::string_view text) {
  if (!text.empty() && text.front() == '#') text.remove_prefix(1);
  const bool has_opacity = text.size() == 8 && (text.substr(6) == "ff" || text.substr(6) == "FF");
  if (text.size() != 6 && !has_opacity) return std::nullopt;
  Rgb color;
  for (std::size_t c = 0; c < color.size(); ++c) {
    unsigned value = 0;
    const char* const first = text.data() + 2 * c;
    const auto [end, error] = std::from_chars(first, first + 2, value, 16);
    if (error != std::errc() || end != first + 2) return std::nullopt;
    color[c] = static_cast<float>(value) / 255;
  }
  return color;
}

// Where all lines are so: else a line of a mark and six letters is a comment.
std::vector<Rgb> colors_of_letters(const std::vector<PaletteLine>& lines) {
  std::vector<Rgb> colors;
  for (const PaletteLine& line : lines) {
    if (line.text.empty()) continue;
    const auto color = color_of_letters(line.text);
    const bool has_letters = line.text.front() == '#' ||
                             line.text.find_first_of("abcdefABCDEF") != std::string_view::npos;
    if (!color || (colors.empty() && !has_letters)) return {};
    colors.push_back(*color);
  }
  return colors;
}

[[noreturn]] void refuse_number(const Knot& knot, std::size_t word, const std::string& name) {
  refuse_palette(name, knot.line.number,
                 fmt::format("found \"{}\", expected a number from 0 to 1, or all whole to 255",
                             shown(knot.words[word])));
}

// A table of particles has numbers in rows, too.
void refuse_columns_of_particles(const Knot& names, const std::string& name) {
  for (const std::string_view word : names.words) {
    const std::string lower = lower_case(std::string(word));
    const bool is_of_particles = lower == "y" || lower == "z" || lower == "mass";
    if (!is_of_particles) continue;
    refuse_palette(name, names.line.number,
                   fmt::format("found a column \"{}\", as of particles, expected red, green and "
                               "blue",
                               shown(word)));
  }
}

// The lines behind comments and at most one line of words. `most` numbers of each: names may
// follow.
std::vector<Knot> knots_in(const std::vector<PaletteLine>& lines, std::size_t most,
                           const std::string& name) {
  std::vector<Knot> knots;
  std::optional<Knot> names;
  for (const PaletteLine& line : lines) {
    if (is_comment(line)) continue;
    Knot knot = {line, palette_words(line.text), {}};
    const bool are_words =
        std::none_of(knot.words.begin(), knot.words.end(),
                     [](std::string_view word) { return palette_number(word).has_value(); });
    if (are_words && knots.empty() && !names) {
      names = std::move(knot);
      continue;
    }
    for (std::size_t i = 0; i < std::min(most, knot.words.size()); ++i) {
      const auto number = palette_number(knot.words[i]);
      if (!number || !std::isfinite(*number)) refuse_number(knot, i, name);
      knot.numbers.push_back(*number);
    }
    knots.push_back(std::move(knot));
  }
  if (knots.empty() && names) refuse_number(*names, 0, name);
  if (names) refuse_columns_of_particles(*names, name);
  return knots;
}

// As many numbers on each line.
std::size_t columns_of(const std::vector<Knot>& knots, const std::string& name) {
  if (knots.empty()) {
    throw DataError(name + ": found no knots, expected lines of 3 or 6 numbers from 0 to 1");
  }
  const std::size_t columns = knots.front().numbers.size();
  if (knots.size() > most_knots) {
    throw DataError(
        fmt::format("{}: found {} rows, expected at most {} colors; a table of particles "
                    "is no palette",
                    name, knots.size(), most_knots));
  }
  for (const Knot& knot : knots) {
    const bool is_known = columns == 3 || columns == 4 || columns == 6;
    if (is_known && knot.numbers.size() == columns) continue;
    const std::string expected =
        is_known ? fmt::format("{} as on the lines before", columns)
                 : "3 (red, green, blue) or 6 (with absorption in red, green, blue)";
    refuse_palette(name, knot.line.number,
                   fmt::format("found {} numbers, expected {}", knot.numbers.size(), expected));
  }
  return columns;
}

// Whether colors are whole numbers up to 255, not parts of 1.
bool are_bytes(const std::vector<Knot>& knots, std::size_t first, std::size_t columns) {
  bool is_any_large = false;
  for (const Knot& knot : knots) {
    for (std::size_t i = first; i < first + columns; ++i) {
      if (knot.numbers[i] != std::floor(knot.numbers[i])) return false;
      is_any_large = is_any_large || knot.numbers[i] > 1;
    }
  }
  return is_any_large;
}

Rgb color_of(const Knot& knot, std::size_t first, float white, const std::string& name) {
  Rgb color;
  for (std::size_t c = 0; c < color.size(); ++c) {
    const float value = knot.numbers[first + c];
    if (!(value >= 0 && value <= white)) refuse_number(knot, first + c, name);
    color[c] = value / white;
  }
  return color;
}

bool is_opaque(const std::vector<Knot>& knots, float white) {
  return std::all_of(knots.begin(), knots.end(),
                     [white](const Knot& knot) { return knot.numbers[3] == white; });
}

bool begin_with_places(const std::vector<Knot>& knots) {
  return knots.size() > 1 &&
         std::is_sorted(knots.begin(), knots.end(),
                        [](const Knot& a, const Knot& b) { return a.numbers[0] < b.numbers[0]; }) &&
         knots.front().numbers[0] < knots.back().numbers[0];
}

// Three colors and something else: an opacity, or a place before them.
std::vector<Rgb> read_four_columns(const std::vector<Knot>& knots, const std::string& name) {
  const float white = are_bytes(knots, 0, 4) ? 255 : 1;
  std::vector<Rgb> colors;
  if (is_opaque(knots, white)) {
    for (const Knot& knot : knots)
      colors.push_back(color_of(knot, 0, white, name));
    return colors;
  }
  if (!begin_with_places(knots)) {
    refuse_palette(name, knots.front().line.number,
                   "found 4 numbers that are no color of opacity 1, nor one behind a rising place; "
                   "expected 3 (red, green, blue) or 6 (with absorption in red, green, blue)");
  }
  const float white_behind = are_bytes(knots, 1, 3) ? 255 : 1;
  std::vector<PlacedColor> placed;
  for (const Knot& knot : knots) {
    placed.push_back({static_cast<double>(knot.numbers[0]), color_of(knot, 1, white_behind, name)});
  }
  return even_knots(placed);
}

// "GIMP Palette", "Name: mine", "Columns: 4", then colors with names behind.
std::vector<PaletteLine> without_gimp_header(const std::vector<PaletteLine>& lines) {
  std::vector<PaletteLine> colors;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string_view> words = palette_words(lines[i].text);
    const bool is_header = !words.empty() && words.front().back() == ':';
    if (!is_header) colors.push_back(lines[i]);
  }
  return colors;
}

bool is_of_gimp(const std::vector<PaletteLine>& lines) {
  return !lines.empty() && lines.front().text.substr(0, 12) == "GIMP Palette";
}

// Red, green and blue from 0 to 255.
Rgb read_bytes_of_color(const PaletteLine& line, const std::string& name) {
  constexpr std::size_t all = 3;
  const std::vector<std::string_view> words = palette_words(line.text);
  Rgb color;
  for (std::size_t c = 0; c < std::min(all, words.size()); ++c) {
    const auto number = palette_number(words[c]);
    if (!number || !(*number >= 0 && *number <= 255)) {
      refuse_palette(name, line.number,
                     fmt::format("found \"{}\", expected a number from 0 to 255", shown(words[c])));
    }
    color[c] = *number / 255;
  }
  if (words.size() >= all) return color;
  refuse_palette(name, line.number,
                 fmt::format("found {} numbers, expected 3: red, green, blue", words.size()));
}

Palette read_gimp_palette(const std::vector<PaletteLine>& lines, const std::string& name) {
  Palette palette;
  palette.name = name;
  for (const PaletteLine& line : without_gimp_header(lines)) {
    if (!is_comment(line)) palette.emission.push_back(read_bytes_of_color(line, name));
  }
  if (palette.emission.empty()) {
    throw DataError(name + ": found no colors, expected lines of red, green and blue to 255");
  }
  return palette;
}

// Lines of numbers: red, green and blue of a knot, from 0 to 1 or as whole numbers to 255. With
// absorption in three more columns; with a place before or an opacity of 1 behind them; as
// #rrggbb; or as GIMP has them, with names behind. Throws DataError.
Palette read_text_palette(const std::vector<PaletteLine>& lines, const std::string& name) {
  if (is_of_gimp(lines)) return read_gimp_palette(lines, name);
  Palette palette;
  palette.name = name;
  palette.emission = colors_of_letters(lines);
  if (!palette.emission.empty()) return palette;
  constexpr std::size_t more_than_any = 1000;
  const std::vector<Knot> knots = knots_in(lines, more_than_any, name);
  const std::size_t columns = columns_of(knots, name);
  if (columns == 4) {
    palette.emission = read_four_columns(knots, name);
    return palette;
  }
  const float white = are_bytes(knots, 0, columns) ? 255 : 1;
  for (const Knot& knot : knots) {
    palette.emission.push_back(color_of(knot, 0, white, name));
    if (columns == 6) palette.absorption.push_back(color_of(knot, 3, white, name));
  }
  return palette;
}

constexpr std::string_view original_mark = "0100";
using Lines = std::vector<PaletteLine>;

bool is_original(const Lines& lines) {
  return lines.size() >= 2 && lines[1].text == original_mark;
}

std::size_t read_knot_count(const Lines& lines, const std::string& name) {
  std::size_t count = 0;
  if (lines.size() > 2) {
    const std::string_view text = lines[2].text;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), count);
    if (result.ec == std::errc() && result.ptr == text.data() + text.size() && count > 0) {
      return count;
    }
  }
  refuse_palette(name, 3,
                 fmt::format("found \"{}\", expected the number of knots",
                             lines.size() > 2 ? shown(lines[2].text) : ""));
}

// A name, the mark, the number of knots, then as many lines of R G B from 0 to 255.
Palette read_original(const Lines& lines, const std::string& name) {
  const std::size_t count = read_knot_count(lines, name);
  Palette palette;
  palette.name = name;
  for (std::size_t i = 3; i < lines.size(); ++i) {
    if (lines[i].text.empty()) continue;
    palette.emission.push_back(read_bytes_of_color(lines[i], name));
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
  const std::string& name = name_for_messages;
  if (auto palette = read_numpy_palette(text, name)) return std::move(*palette);
  if (auto palette = read_byte_palette(text, name)) return std::move(*palette);
  if (auto palette = read_paraview_palette(text, name)) return std::move(*palette);
  if (auto palette = read_sao_palette(text, name)) return std::move(*palette);
  const Lines lines = palette_lines(text);
  if (is_original(lines)) return read_original(lines, name);
  if (auto palette = read_gmt_palette(lines, name)) return std::move(*palette);
  return read_text_palette(lines, name);
}

std::string palette_description(const std::string& text, const std::string& name) {
  const Lines lines = palette_lines(text);
  if (lines.empty()) return "";
  std::string_view first = lines.front().text;
  if (!is_original(lines)) {
    if (first.empty() || first.front() != '#') return "";
    first = without_spaces(first.substr(1));
  }
  const std::string label = name + ":";
  if (first.substr(0, label.size()) == label) first = without_spaces(first.substr(label.size()));
  const bool is_text = std::none_of(first.begin(), first.end(), [](char c) {
    return static_cast<unsigned char>(c) < ' ' && c != '\t';
  });
  return is_text ? std::string(first) : "";
}

}  // namespace splotchcl
