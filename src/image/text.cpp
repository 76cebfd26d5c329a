#include "image/text.h"

#include <fmt/format.h>
#include <ft2build.h>

#include <algorithm>
#include <array>
#include <boost/regex/pending/unicode_iterator.hpp>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <new>
#include <optional>
#include <stdexcept>
#include <vector>
#include FT_FREETYPE_H

#include "common/words.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 3> font_endings = {".ttf", ".otf", ".ttc"};

bool is_font_ending(const std::string& ending) {
  return std::find(font_endings.begin(), font_endings.end(), lower_case(ending)) !=
         font_endings.end();
}

std::vector<fs::path> font_folders() {
  std::vector<fs::path> folders;
  // Not in the folder that is current, which may be anyone's.
  if (const char* const home = std::getenv("HOME"); home != nullptr && *home == '/') {
    folders.push_back(fs::path(home) / ".local/share/fonts");
    folders.push_back(fs::path(home) / ".fonts");
    folders.push_back(fs::path(home) / "Library/Fonts");
  }
  for (const char* const folder :
       {"/usr/local/share/fonts", "/usr/share/fonts", "/Library/Fonts", "/System/Library/Fonts"}) {
    folders.emplace_back(folder);
  }
  return folders;
}

// The first in the order of names, so that it is the same every time.
std::optional<fs::path> find_in(const fs::path& folder, const std::string& name) {
  std::optional<fs::path> found;
  std::error_code error;
  const auto options = fs::directory_options::skip_permission_denied;
  for (fs::recursive_directory_iterator entry(folder, options, error), end; !error && entry != end;
       entry.increment(error)) {
    const fs::path& file = entry->path();
    const bool fits = is_font_ending(file.extension().string()) &&
                      lower_case(file.stem().string()) == lower_case(name);
    if (fits && (!found || file < *found)) found = file;
  }
  return found;
}

}  // namespace

bool is_font_path(const std::string& font) {
  return font.find('/') != std::string::npos || is_font_ending(fs::path(font).extension().string());
}

fs::path find_font(const std::string& name) {
  if (is_font_path(name)) {
    std::error_code error;
    if (fs::is_regular_file(name, error)) return name;
    throw UsageError("finish.font: found no file " + name + ", expected a font file (.ttf, .otf)");
  }
  std::string searched;
  for (const fs::path& folder : font_folders()) {
    if (const std::optional<fs::path> font = find_in(folder, name)) return *font;
    searched += (searched.empty() ? "" : ", ") + folder.string();
  }
  throw UsageError("finish.font: found no " + name + ".ttf in " + searched +
                   "; install it (on Debian: apt-get install fonts-dejavu-core) or give the path "
                   "of a font file as finish.font");
}

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
