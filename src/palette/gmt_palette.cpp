#include <fmt/format.h>

#include <algorithm>

#include "common/words.h"
#include "palette/other_palettes.h"
#include "palette/placed_colors.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

bool is_color_of_ends(std::string_view word) {
  return word == "B" || word == "F" || word == "N";
}

// "0 0 0 255 1 255 255 255", and "0 0/0/255 1 255/255/255" of later versions.
std::vector<float> numbers_of(const PaletteLine& line, const std::string& name) {
  std::string text(line.text);
  std::replace(text.begin(), text.end(), '/', ' ');
  std::vector<float> numbers;
  for (const std::string_view word : palette_words(text)) {
    constexpr std::size_t all = 8;
    const auto number = palette_number(word);
    if (number) numbers.push_back(*number);
    if (numbers.size() == all) return numbers;  // a letter or a label may follow
    if (number) continue;
    refuse_palette(name, line.number,
                   fmt::format("found \"{}\", expected a value, red, green, blue, and these again",
                               shown(word)));
  }
  refuse_palette(name, line.number,
                 fmt::format("found {} numbers, expected 8: a value, red, green, blue, and these "
                             "again",
                             numbers.size()));
}

Rgb color_in(const std::vector<float>& numbers, std::size_t first, const PaletteLine& line,
             const std::string& name) {
  Rgb color;
  for (std::size_t c = 0; c < color.size(); ++c) {
    const float value = numbers[first + c];
    if (!(value >= 0 && value <= 255)) {
      refuse_palette(name, line.number,
                     fmt::format("found {} for a color, expected numbers from 0 to 255", value));
    }
    color[c] = value / 255;
  }
  return color;
}

// Of comments: # COLOR_MODEL = HSV.
void refuse_other_model(const std::vector<PaletteLine>& lines, const std::string& name) {
  for (const PaletteLine& line : lines) {
    const std::string text = lower_case(std::string(line.text));
    const bool is_other =
        text.find("color_model") != std::string::npos && text.find("rgb") == std::string::npos;
    if (!is_other) continue;
    refuse_palette(name, line.number,
                   fmt::format("found \"{}\", expected COLOR_MODEL = RGB", shown(line.text)));
  }
}

bool ends_as_gmt(const std::string& name) {
  return lower_ending(name) == ".cpt";
}

}  // namespace

std::optional<Palette> read_gmt_palette(const std::vector<PaletteLine>& lines,
                                        const std::string& name) {
  if (!ends_as_gmt(name)) return std::nullopt;
  refuse_other_model(lines, name);
  std::vector<PlacedColor> colors;
  for (const PaletteLine& line : lines) {
    const std::vector<std::string_view> words = palette_words(line.text);
    if (words.empty() || line.text.front() == '#' || is_color_of_ends(words.front())) continue;
    const std::vector<float> numbers = numbers_of(line, name);
    const bool goes_on = numbers[4] > numbers[0] &&
                         (colors.empty() || static_cast<double>(numbers[0]) >= colors.back().place);
    if (!goes_on) refuse_palette(name, line.number, "found values that fall, expected rising ones");
    colors.push_back({static_cast<double>(numbers[0]), color_in(numbers, 1, line, name)});
    colors.push_back({static_cast<double>(numbers[4]), color_in(numbers, 5, line, name)});
  }
  if (colors.empty()) {
    throw DataError(fmt::format("{}: found no colors, expected lines of 8 numbers", name));
  }
  // Where one part ends as the next begins.
  const auto is_same = [](const PlacedColor& a, const PlacedColor& b) {
    return a.place == b.place && a.color == b.color;
  };
  colors.erase(std::unique(colors.begin(), colors.end(), is_same), colors.end());
  Palette palette;
  palette.name = name;
  palette.emission = even_knots(colors);
  return palette;
}

}  // namespace splotchcl
