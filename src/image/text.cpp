#include "image/text.h"

#include <fmt/format.h>
#include <ft2build.h>
#include FT_FREETYPE_H

#include <algorithm>
#include <boost/regex/pending/unicode_iterator.hpp>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <new>
#include <optional>
#include <stdexcept>

#include "image/font_folders.h"
#include "splotchcl/error.h"

namespace splotchcl {

struct Font::Face {
  FT_Library library = nullptr;
  FT_Face face = nullptr;

  Face() = default;
  Face(const Face&) = delete;
  Face& operator=(const Face&) = delete;
  ~Face() {
    if (face != nullptr) FT_Done_Face(face);
    if (library != nullptr) FT_Done_FreeType(library);
  }
};

namespace {

// FreeType's lengths are in 1/64 of a pixel.
double pixels(FT_Pos length) {
  return static_cast<double>(length) / 64;
}

// The text's lines as code points.
std::vector<std::u32string> lines_of(const std::string& text) {
  std::vector<std::u32string> lines(1);
  try {
    using Decoder = boost::u8_to_u32_iterator<std::string::const_iterator>;
    const Decoder end(text.end(), text.begin(), text.end());
    for (Decoder letter(text.begin(), text.begin(), text.end()); letter != end; ++letter) {
      if (*letter == U'\n') {
        lines.emplace_back();
      } else {
        lines.back() += static_cast<char32_t>(*letter);
      }
    }
  } catch (const std::out_of_range&) {
    throw UsageError("the text \"" + text + "\" is not UTF-8, expected UTF-8");
  }
  return lines;
}

struct PlacedGlyph {
  FT_UInt index;
  double x;  // from the line's start
};

struct Line {
  std::vector<PlacedGlyph> glyphs;
  double width = 0;
};

Line lay_out(FT_Face face, const std::u32string& text) {
  Line line;
  FT_UInt last = 0;
  for (const char32_t letter : text) {
    const FT_UInt index = FT_Get_Char_Index(face, letter);
    FT_Vector kerning{};
    if (last != 0) FT_Get_Kerning(face, last, index, FT_KERNING_UNFITTED, &kerning);
    line.width += pixels(kerning.x);
    line.glyphs.push_back({index, line.width});
    if (FT_Load_Glyph(face, index, FT_LOAD_NO_HINTING) != 0) continue;
    line.width += static_cast<double>(face->glyph->linearHoriAdvance) / 65536;
    last = index;
  }
  return line;
}

// Adds the glyph with its origin at (x, baseline) of the mask.
void draw_glyph(FT_Face face, FT_UInt index, double x, int baseline, TextMask& mask) {
  const double whole = std::floor(x);
  FT_Vector shift{std::lround((x - whole) * 64), 0};
  FT_Set_Transform(face, nullptr, &shift);
  const bool is_drawn = FT_Load_Glyph(face, index, FT_LOAD_NO_HINTING | FT_LOAD_RENDER) == 0;
  FT_Set_Transform(face, nullptr, nullptr);
  if (!is_drawn) return;
  const FT_GlyphSlot glyph = face->glyph;
  const int left = static_cast<int>(whole) + glyph->bitmap_left;
  const int top = baseline - glyph->bitmap_top;
  const auto rows = static_cast<int>(glyph->bitmap.rows);
  const auto columns = static_cast<int>(glyph->bitmap.width);
  for (int y = std::max(0, -top); y < std::min(rows, mask.height - top); ++y) {
    for (int i = std::max(0, -left); i < std::min(columns, mask.width - left); ++i) {
      const auto value = static_cast<float>(glyph->bitmap.buffer[y * glyph->bitmap.pitch + i]);
      float& pixel =
          mask.coverage[static_cast<std::size_t>(top + y) * static_cast<std::size_t>(mask.width) +
                        static_cast<std::size_t>(left + i)];
      pixel = std::min(1.0F, pixel + value / 255);
    }
  }
}

double cap_height(FT_Face face) {
  if (FT_Load_Char(face, 'H', FT_LOAD_NO_HINTING) != 0) return 0.7 * face->size->metrics.y_ppem;
  return pixels(face->glyph->metrics.horiBearingY);
}

double start_of(const Line& line, double width, TextAlignment alignment) {
  const double rest = width - line.width;
  if (alignment == TextAlignment::left) return 0;
  return alignment == TextAlignment::center ? rest / 2 : rest;
}

}  // namespace

Font::Font(const std::string& name) : name_(name), face_(std::make_shared<Face>()) {
  const std::filesystem::path file = find_font(name);
  if (FT_Init_FreeType(&face_->library) != 0) throw std::bad_alloc();
  const FT_Error error = FT_New_Face(face_->library, file.c_str(), 0, &face_->face);
  if (error == FT_Err_Out_Of_Memory) throw std::bad_alloc();
  if (error == FT_Err_Cannot_Open_Resource) {
    throw DataError("font " + file.string() + ": cannot be opened; check its permissions");
  }
  if (error != 0 || !FT_IS_SCALABLE(face_->face)) {
    throw UsageError("font " + file.string() +
                     ": found no font with outlines, expected a .ttf or .otf file");
  }
}

bool Font::has(char32_t letter) const {
  return FT_Get_Char_Index(face_->face, letter) != 0;
}

TextMask Font::draw(const std::string& text, double size_pixels, TextAlignment alignment) const {
  const FT_Face face = face_->face;
  FT_Set_Char_Size(face, 0, std::max<FT_F26Dot6>(64, std::lround(64 * size_pixels)), 72, 72);
  const double spacing = 1.35 * size_pixels;
  double width = 0;
  std::vector<Line> lines;
  for (const std::u32string& line : lines_of(text)) {
    for (const char32_t letter : line) {
      if (has(letter)) continue;
      throw UsageError(
          fmt::format("the font {} has no letter U+{:04X}, found in \"{}\"; choose "
                      "another font (finish.font) or other words",
                      name_, static_cast<unsigned>(letter), text));
    }
    lines.push_back(lay_out(face, line));
    width = std::max(width, lines.back().width);
  }
  TextMask mask;
  const double capitals = cap_height(face);
  const double box_height = capitals + spacing * static_cast<double>(lines.size() - 1);
  const int margin = static_cast<int>(std::ceil(0.5 * size_pixels));
  mask.left = -margin;
  mask.top = -margin;
  mask.box_width = static_cast<int>(std::ceil(width));
  mask.box_height = static_cast<int>(std::ceil(box_height));
  mask.width = mask.box_width + 2 * margin;
  mask.height = mask.box_height + 2 * margin;
  constexpr double most_pixels = 1 << 25;
  if (static_cast<double>(mask.width) * mask.height > most_pixels) {
    throw UsageError(
        fmt::format("the text \"{}...\" takes {}x{} pixels, expected at most {:.0f} in all; make "
                    "it shorter, or "
                    "its letters smaller",
                    text.substr(0, text.find_first_of(" \n")).substr(0, 20), mask.width,
                    mask.height, most_pixels));
  }
  mask.coverage.resize(static_cast<std::size_t>(mask.width) *
                       static_cast<std::size_t>(mask.height));
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const double start = margin + start_of(lines[i], width, alignment);
    const double above = capitals + spacing * static_cast<double>(i);
    for (const PlacedGlyph& glyph : lines[i].glyphs) {
      draw_glyph(face, glyph.index, start + glyph.x, margin + static_cast<int>(std::ceil(above)),
                 mask);
    }
  }
  return mask;
}

}  // namespace splotchcl
