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

// Whether a scene means a file by this, rather than the name of a palette: it has a '/'
// or a '.' in it.
bool is_palette_path(const std::string& name);

// The text of a palette file of ours (docs/palettes.md), or of the original program's
// .pal, told apart by content. Throws DataError with name_for_messages and line.
Palette parse_palette(const std::string& text, const std::string& name_for_messages);

// What the first comment of a palette file says, without "name:" in front; the first line of the
// original program's .pal. Empty where there is none.
std::string palette_description(const std::string& text, const std::string& name);

// Palettes in the forms of other programs. Each is none where the file is something else, and
// throws DataError with the file's name where it is damaged.

// 256 colors as bytes: red, green and blue of each (Adobe's .act), or all of red, of green and of
// blue (ImageJ's .lut), which the ending of the name tells apart.
std::optional<Palette> read_byte_palette(const std::string& bytes, const std::string& name);

// An array of NumPy (.npy): a row for each color.
std::optional<Palette> read_numpy_palette(const std::string& bytes, const std::string& name);

// ParaView's color maps, in JSON or XML: the first of a file.
std::optional<Palette> read_paraview_palette(const std::string& text, const std::string& name);

// GMT's tables of colors between values (.cpt), in RGB.
std::optional<Palette> read_gmt_palette(const std::vector<PaletteLine>& lines,
                                        const std::string& name);

// DS9's and SAOimage's, where red, green and blue have places of their own.
std::optional<Palette> read_sao_palette(const std::string& text, const std::string& name);

}  // namespace splotchcl
