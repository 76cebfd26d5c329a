#include <algorithm>
#include <cmath>

#include "finish/overlay.h"
#include "map/figure.h"
#include "map/sheet.h"

namespace splotchcl {
namespace {

// Lengths in points, from the lower left corner of the page.
constexpr double map_side = 360, margin = 12, text_size = 10, tick = 4, pen = 0.8;
constexpr double left_of_map = 64, below_map = 44, bar_gap = 16, bar_width = 14, right_of_bar = 64,
                 above_map = 34;

struct PageAxis {
  std::string label;
  std::vector<Tick> marks;
};

std::vector<Tick> marks_between(bool is_logarithmic, double first, double last) {
  if (!is_logarithmic) return ticks_of({Scaling::linear, first, last}, 6, true);
  return ticks_of({Scaling::log, std::log10(first), std::log10(last)}, 6, true);
}

PageAxis axis_of_lengths(const std::string& name, const std::string& unit, double center,
                         double half) {
  return {name + " [" + unit + "]", marks_between(false, center - half, center + half)};
}

PageAxis axis_of(const MapAxis& axis) {
  std::string name = axis.name;
  std::replace(name.begin(), name.end(), '_', ' ');
  return {name + " [" + readable_unit(axis.unit, true) + "]",
          marks_between(axis.is_logarithmic, axis.first, axis.last)};
}

struct PageSize {
  double width, height;  // of what has axes

  double whole_width(bool has_bar) const {
    return left_of_map + width + (has_bar ? bar_gap + bar_width + right_of_bar : 2 * margin);
  }
  double whole_height() const { return below_map + height + above_map; }
};

class FigurePage {
 public:
  FigurePage(Sheet& sheet, const PageSize& size) : sheet_(sheet), size_(size) {}

  void draw_map(const Figure& figure) {
    const Map& map = figure.map;
    sheet_.picture(figure.picture(), left_of_map, below_map, size_.width, size_.height);
    const double scale = size_.width / map.width;
    std::vector<SheetLine> contours;
    for (const double level : figure.levels) {
      for (const auto& [a, b] : contour_pieces(map, level)) {
        contours.push_back(
            {{{left_of_map + a[0] * scale, below_map + size_.height - a[1] * scale},
              {left_of_map + b[0] * scale, below_map + size_.height - b[1] * scale}}});
      }
    }
    sheet_.lines(contours, 0.6, 1);
    sheet_.frame(left_of_map, below_map, size_.width, size_.height, pen);
  }

  // A line through values at places from 0 to 1, broken where there is none.
  void draw_curve(const std::vector<std::array<double, 2>>& places) {
    std::vector<SheetLine> lines;
    for (std::size_t i = 1; i < places.size(); ++i) {
      const auto on_page = [this](const std::array<double, 2>& place) {
        return std::array<double, 2>{left_of_map + place[0] * size_.width,
                                     below_map + std::clamp(place[1], 0.0, 1.0) * size_.height};
      };
      const bool is_known = std::isfinite(places[i - 1][1]) && std::isfinite(places[i][1]);
      if (is_known) lines.push_back({{on_page(places[i - 1]), on_page(places[i])}});
    }
    sheet_.lines(lines, 1.5, 0);
    sheet_.frame(left_of_map, below_map, size_.width, size_.height, pen);
  }

  void draw_axis_below(const PageAxis& axis) {
    std::vector<SheetLine> marks;
    for (const Tick& mark : axis.marks) {
      const double x = left_of_map + mark.position * size_.width;
      marks.push_back({{{x, below_map}, {x, below_map - length_of(mark)}}});
      text(mark.label, x, below_map - tick - text_size, Align::center);
    }
    sheet_.lines(marks, pen, 0);
    text(axis.label, left_of_map + size_.width / 2, margin, Align::center);
  }

  void draw_axis_on_left(const PageAxis& axis) {
    std::vector<SheetLine> marks;
    for (const Tick& mark : axis.marks) {
      const double y = below_map + mark.position * size_.height;
      marks.push_back({{{left_of_map, y}, {left_of_map - length_of(mark), y}}});
      text(mark.label, left_of_map - tick - 2, y - 0.35 * text_size, Align::right);
    }
    sheet_.lines(marks, pen, 0);
    text(axis.label, margin + 0.8 * text_size, below_map + size_.height / 2, Align::center, true);
  }

  void draw_bar(const Figure& figure, const std::string& label) {
    const double left = left_of_map + size_.width + bar_gap, right = left + bar_width;
    constexpr int steps = 512;
    Image colors(1, steps);
    for (int i = 0; i < steps; ++i) {
      const auto color = sample_knots(figure.palette.emission, 1 - (i + 0.5) / steps);
      for (std::size_t c = 0; c < 3; ++c)
        colors.at(0, i)[c] = static_cast<float>(color[c]);
    }
    sheet_.picture(colors, left, below_map, bar_width, size_.height);
    sheet_.frame(left, below_map, bar_width, size_.height, pen);
    std::vector<SheetLine> marks;
    for (const Tick& mark : figure.colors.ticks(static_cast<int>(size_.height / 40), true)) {
      const double y = below_map + mark.position * size_.height;
      marks.push_back({{{right, y}, {right + length_of(mark), y}}});
      text(mark.label, right + tick + 2, y - 0.35 * text_size, Align::left);
    }
    sheet_.lines(marks, pen, 0);
    text(label, right + right_of_bar - margin, 0.5 * size_.whole_height(), Align::center, true);
  }

  void draw_title(const std::string& words) {
    sheet_.text(words, left_of_map + size_.width / 2, below_map + size_.height + margin,
                Align::center, false, 1.3 * text_size);
  }

 private:
  static double length_of(const Tick& mark) { return (mark.label.empty() ? 0.5 : 1) * tick; }
  void text(const std::string& words, double x, double y, Align align, bool is_turned = false) {
    if (!words.empty()) sheet_.text(words, x, y, align, is_turned, text_size);
  }

  Sheet& sheet_;
  PageSize size_;
};

// Of a histogram bins may be no squares.
PageSize size_of_map(const Map& map) {
  if (map.shape == MapShape::histogram) return {map_side, map_side};
  return {map.width >= map.height ? map_side : map_side * map.width / map.height,
          map.height >= map.width ? map_side : map_side * map.height / map.width};
}

void draw_axes(const Map& map, FigurePage& page) {
  if (map.shape == MapShape::sky || map.shape == MapShape::healpix) return;
  if (!map.axes.empty()) {
    page.draw_axis_below(axis_of(map.axes[0]));
    page.draw_axis_on_left(axis_of(map.axes[1]));
    return;
  }
  page.draw_axis_below(axis_of_lengths(map.right_name, map.length_unit, map.center_right,
                                       0.5 * map.width * map.pixel));
  page.draw_axis_on_left(
      axis_of_lengths(map.up_name, map.length_unit, map.center_up, 0.5 * map.height * map.pixel));
}

void draw_title(const Scene& scene, const SnapshotInfo& snapshot, FigurePage& page) {
  const FinishSettings& finish = scene.finish;
  if (finish.title.text.empty()) return;
  page.draw_title(replace_placeholders(finish.title.text, snapshot, finish.frame.value_or(0),
                                       "finish.title.text"));
}

void draw_map_page(const Figure& figure, const Scene& scene, const SnapshotInfo& snapshot,
                   Sheet& sheet) {
  FigurePage page(sheet, size_of_map(figure.map));
  page.draw_map(figure);
  draw_axes(figure.map, page);
  const auto& labels = scene.finish.color_bar.labels;
  page.draw_bar(figure, labels.empty() ? figure.label : labels.front());
  draw_title(scene, snapshot, page);
}

constexpr PageSize profile_size = {map_side, 0.75 * map_side};

void draw_profile_page(const Figure& figure, const Scene& scene, const SnapshotInfo& snapshot,
                       Sheet& sheet) {
  const Map& map = figure.map;
  FigurePage page(sheet, profile_size);
  std::vector<std::array<double, 2>> places;
  for (int i = 0; i < map.width; ++i) {
    const double value =
        figure.colors.place(static_cast<double>(map.values[static_cast<std::size_t>(i)]));
    places.push_back({(i + 0.5) / map.width, value});
  }
  page.draw_curve(places);
  page.draw_axis_below(axis_of(map.axes[0]));
  page.draw_axis_on_left({figure.label, figure.colors.ticks(8, true)});
  draw_title(scene, snapshot, page);
}

void draw_page(const Figure& figure, const Scene& scene, const SnapshotInfo& snapshot,
               Sheet& sheet) {
  if (figure.map.shape == MapShape::profile) {
    draw_profile_page(figure, scene, snapshot, sheet);
  } else {
    draw_map_page(figure, scene, snapshot, sheet);
  }
}

PageSize size_of_page(const Map& map) {
  const bool is_profile = map.shape == MapShape::profile;
  const PageSize size = is_profile ? profile_size : size_of_map(map);
  return {size.whole_width(!is_profile), size.whole_height()};
}

}  // namespace

std::vector<unsigned char> encode_pdf(const std::filesystem::path& path, const Figure& figure,
                                      const Scene& scene, const SnapshotInfo& snapshot) {
  const PageSize size = size_of_page(figure.map);
  PdfSheet sheet(path, scene.finish.font, size.width, size.height);
  draw_page(figure, scene, snapshot, sheet);
  return sheet.bytes();
}

Image draw_figure_with_axes(const Figure& figure, const Scene& scene,
                            const SnapshotInfo& snapshot) {
  const PageSize size = size_of_page(figure.map);
  const double scale = std::max(1.0, std::max(scene.image.width, scene.image.height) / size.width);
  PictureSheet sheet(scene.finish.font, size.width, size.height, scale);
  draw_page(figure, scene, snapshot, sheet);
  return sheet.image();
}

}  // namespace splotchcl
