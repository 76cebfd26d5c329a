#include "cli/palette_preview.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

#include "finish/canvas.h"
#include "image/text.h"
#include "scene/ceil_divide.h"

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

}  // namespace

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

}  // namespace splotchcl::cli
