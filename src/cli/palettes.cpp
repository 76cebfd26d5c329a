#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iostream>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/json_answer.h"
#include "common/output_files.h"
#include "common/words.h"
#include "finish/overlay.h"
#include "image/text.h"
#include "scene/ceil_divide.h"
#include "splotchcl/error.h"
#include "splotchcl/image.h"
#include "splotchcl/image_file.h"
#include "splotchcl/palette.h"
#include "splotchcl/palette_file.h"

namespace splotchcl::cli {
namespace {

constexpr int bar_width = 256, bar_height = 22;
constexpr int row_height = 30, margin = 16, gap = 12;
constexpr double letter_size = 16;
constexpr Light background = {0.12F, 0.12F, 0.12F}, letter_light = {0.9F, 0.9F, 0.9F};

// What is not plain ASCII becomes question marks, since the font may lack it.
TextMask draw_name(const Font& font, std::string name) {
  std::replace_if(
      name.begin(), name.end(),
      [](char letter) {
        const auto byte = static_cast<unsigned char>(letter);
        return byte < 32 || byte >= 127;
      },
      '?');
  return font.draw(name, letter_size);
}

// How the rows are spread over columns.
struct Grid {
  int rows = 0, columns = 0;
};

Grid choose_grid(int count, int column_width) {
  Grid grid;
  do {
    ++grid.columns;
    grid.rows = ceil_divide(count, grid.columns);
  } while (grid.rows * row_height > grid.columns * column_width);
  return grid;
}

void draw_bar(Image& image, int left, int top, const Palette& palette) {
  const std::vector<Rgb>& lower =
      palette.has_own_absorption() ? palette.absorption : palette.emission;
  for (int x = 0; x < bar_width; ++x) {
    const double position = static_cast<double>(x) / (bar_width - 1);
    for (int y = 0; y < bar_height; ++y) {
      const auto& knots = y < bar_height / 2 ? palette.emission : lower;
      const std::array<double, 3> color = sample_knots(knots, position);
      float* const pixel = image.at(left + x, top + y);
      for (std::size_t c = 0; c < 3; ++c)
        pixel[c] = static_cast<float>(color[c]);
    }
  }
}

// The palettes' names beside bars of their colours, lowest values on the left, in as many columns
// as keep the picture from getting taller than wide. The lower half of a bar is what the palette
// absorbs, where it has absorption colours of its own. Throws UsageError where no font is found.
Image draw_palette_preview(const std::vector<Palette>& palettes) {
  const Font font("DejaVuSans");
  std::vector<TextMask> names;
  int name_width = 0;
  for (const Palette& palette : palettes) {
    names.push_back(draw_name(font, palette.name));
    name_width = std::max(name_width, names.back().box_width);
  }
  const int column_width = name_width + gap + bar_width + margin;
  const Grid grid = choose_grid(static_cast<int>(palettes.size()), column_width);
  Image image(margin + grid.columns * column_width, 2 * margin + grid.rows * row_height);
  Canvas canvas(image, {0, 0, image.width, image.height});
  canvas.fill({0, 0, static_cast<double>(image.width), static_cast<double>(image.height)},
              background);
  for (std::size_t i = 0; i < palettes.size(); ++i) {
    const int row = static_cast<int>(i) % grid.rows, column = static_cast<int>(i) / grid.rows;
    const int left = margin + column * column_width;
    const int top = margin + row * row_height + (row_height - bar_height) / 2;
    const TextMask& name = names[i];
    canvas.stamp(name, left + name_width - name.box_width + name.left,
                 top + (bar_height - name.box_height) / 2 + name.top, letter_light);
    draw_bar(image, left + name_width + gap, top, palettes[i]);
  }
  return image;
}

struct ListedPalette {
  PaletteInfo info;
  Palette palette;
};

// Those that are named; all where none is. One of the user's files that is no palette does not keep
// the others from being listed.
std::vector<ListedPalette> choose(const std::vector<std::string>& names, Console& console) {
  std::vector<ListedPalette> chosen;
  const std::vector<PaletteInfo> all = list_palettes();
  for (const std::string& name : names) {
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const PaletteInfo& info) { return info.name == name; });
    chosen.push_back({found == all.end() ? PaletteInfo{name, {}, ""} : *found, load_palette(name)});
  }
  if (!names.empty()) return chosen;
  for (const PaletteInfo& info : all) {
    try {
      chosen.push_back({info, load_palette(info.name)});
    } catch (const DataError& error) {
      console.note(std::string("left out: ") + error.what());
    }
  }
  return chosen;
}

// Where it comes from, if that is a file, and what its file says of it.
std::string remark(const PaletteInfo& info) {
  if (info.file.empty()) return info.description;
  const std::string separator = info.description.empty() ? "" : ": ";
  return info.file.string() + separator + info.description;
}

void print_text(const std::vector<ListedPalette>& palettes) {
  std::size_t width = 0;
  for (const ListedPalette& listed : palettes)
    width = std::max(width, listed.info.name.size());
  for (const ListedPalette& listed : palettes) {
    const std::string line = fmt::format("{:{}}  {:>3}  {}", listed.info.name, width,
                                         listed.palette.emission.size(), remark(listed.info));
    std::cout << printable(line) << "\n";
  }
}

Json json_of_palette(const ListedPalette& listed) {
  Json json = {{"name", listed.info.name},
               {"knots", listed.palette.emission.size()},
               {"has_own_absorption", listed.palette.has_own_absorption()},
               {"description", listed.info.description}};
  if (!listed.info.file.empty()) json["file"] = listed.info.file.string();
  return json;
}

std::set<std::filesystem::path> files_read(const PalettesOptions& options) {
  std::set<std::filesystem::path> files(options.names.begin(), options.names.end());
  for (const PaletteInfo& info : list_palettes()) {
    if (!info.file.empty()) files.insert(info.file);
  }
  return files;
}

void write_preview(const std::filesystem::path& path, const std::vector<ListedPalette>& listed) {
  std::vector<Palette> palettes;
  for (const ListedPalette& one : listed) {
    palettes.push_back(one.palette);
    palettes.back().name = one.info.name;
  }
  write_image(path, draw_palette_preview(palettes));
}

}  // namespace

int run_palettes(const PalettesOptions& options, Console& console) {
  if (options.preview) {
    check_image_path(*options.preview);
    check_outputs({{*options.preview, "--preview"}}, [&] { return files_read(options); });
  }
  const std::vector<ListedPalette> palettes = choose(options.names, console);
  if (options.preview) write_preview(*options.preview, palettes);
  if (options.json) {
    print_json_list(palettes, json_of_palette);
  } else {
    print_text(palettes);
  }
  return 0;
}

}  // namespace splotchcl::cli
