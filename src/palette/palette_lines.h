#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "splotchcl/palette.h"

namespace splotchcl {

// More rows than any palette has are those of something else.
constexpr std::size_t most_knots = 4096;

// A line of a palette file.
struct PaletteLine {
  std::string_view text;  // without spaces around it
  std::size_t number = 0;
};

std::vector<PaletteLine> palette_lines(std::string_view text);

// Apart by white space, commas or semicolons.
std::vector<std::string_view> palette_words(std::string_view text);

std::string_view without_spaces(std::string_view text);
std::optional<float> palette_number(std::string_view word);

// As a message may show it: what is no text is left out.
std::string shown(std::string_view text);

[[noreturn]] void refuse_palette(const std::string& name, std::size_t line,
                                 const std::string& problem);

// A color and where it is.
struct PlacedColor {
  double place = 0;
  Rgb color;
};

// Knots at even steps from the first place to the last, which must not decrease: the colors
// themselves where they are so, else many between them.
std::vector<Rgb> even_knots(const std::vector<PlacedColor>& colors);

}  // namespace splotchcl
