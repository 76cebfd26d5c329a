#include "map/figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "cells/sky_grid.h"
#include "finish/finish_picture.h"
#include "finish/ticks.h"
#include "map/map_colors.h"
#include "scene/constants.h"
#include "splotchcl/palette_file.h"
#include "splotchcl/plan.h"

namespace splotchcl {
namespace {

// The direction that is seen at a place of the ellipse, from -1 to 1 along both of its axes.
Vec3 direction_at(double x, double y) {
  const double angle = std::asin(y), half_width = std::cos(angle);
  const double latitude = std::asin((2 * angle + std::sin(2 * angle)) / pi);
  const double longitude = half_width > 0 ? -pi * x / half_width : 0;
  return {{std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
           std::sin(latitude)}};
}

}  // namespace

Map picture_of_sphere(const Map& map, int width) {
  Map picture = map;
  picture.width = width;
  picture.height = (width + 1) / 2;
  picture.values.clear();
  const HealpixGrid grid(map.healpix->nside, map.healpix->order);
  for (int row = 0; row < picture.height; ++row) {
    for (int column = 0; column < picture.width; ++column) {
      const double x = 2 * (column + 0.5) / picture.width - 1,
                   y = 1 - 2 * (row + 0.5) / picture.height;
      const bool is_sky = x * x + y * y < 1;
      picture.values.push_back(is_sky ? map.values[*grid.cell_at(direction_at(x, y))]
                                      : std::numeric_limits<float>::quiet_NaN());
    }
  }
  return picture;
}

namespace {

using Place = std::array<double, 2>;

// Four neighboring pixels around a square: top left, top right, bottom right, bottom left.
class Square {
 public:
  Square(const Map& map, int column, int row, double level)
      : column_(column), row_(row), level_(level) {
    constexpr int right[] = {0, 1, 1, 0}, down[] = {0, 0, 1, 1};
    for (std::size_t k = 0; k < 4; ++k) {
      const int x = column + right[k], y = row + down[k];
      values_[k] = static_cast<double>(map.values[static_cast<std::size_t>(y * map.width + x)]);
    }
  }

  void add_pieces(std::vector<ContourPiece>& pieces) const {
    std::vector<Place> crossings;
    for (std::size_t side = 0; side < 4; ++side) {
      if (is_above(side) != is_above((side + 1) % 4)) crossings.push_back(crossing(side));
    }
    if (crossings.size() == 2) pieces.push_back({crossings[0], crossings[1]});
    if (crossings.size() < 4) return;
    // Sides in order are top, right, bottom, left: the pieces cut off two opposite corners.
    const double mean = (values_[0] + values_[1] + values_[2] + values_[3]) / 4;
    const bool cuts_top_right = (mean >= level_) == is_above(0);
    const std::size_t first = cuts_top_right ? 1 : 3;
    pieces.push_back({crossings[0], crossings[first]});
    pieces.push_back({crossings[2], crossings[4 - first]});
  }

  bool is_known() const { return std::isfinite(values_[0] + values_[1] + values_[2] + values_[3]); }

 private:
  bool is_above(std::size_t corner) const { return values_[corner] >= level_; }

  Place corner(std::size_t k) const {
    return {column_ + 0.5 + (k == 1 || k == 2 ? 1 : 0), row_ + 0.5 + (k >= 2 ? 1 : 0)};
  }

  Place crossing(std::size_t side) const {
    const std::size_t next = (side + 1) % 4;
    const double part = (level_ - values_[side]) / (values_[next] - values_[side]);
    const Place a = corner(side), b = corner(next);
    return {a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])};
  }

  int column_, row_;
  double level_;
  std::array<double, 4> values_;
};

}  // namespace

std::vector<ContourPiece> contour_pieces(const Map& map, double level) {
  std::vector<ContourPiece> pieces;
  for (int row = 0; row + 1 < map.height; ++row) {
    for (int column = 0; column + 1 < map.width; ++column) {
      const Square square(map, column, row, level);
      if (square.is_known()) square.add_pieces(pieces);
    }
  }
  return pieces;
}

namespace {

double distance_to(const ContourPiece& piece, double x, double y) {
  const auto& [a, b] = piece;
  const double dx = b[0] - a[0], dy = b[1] - a[1], square = dx * dx + dy * dy;
  const double along =
      square > 0 ? std::clamp(((x - a[0]) * dx + (y - a[1]) * dy) / square, 0.0, 1.0) : 0;
  return std::hypot(x - a[0] - along * dx, y - a[1] - along * dy);
}

// How much of each pixel the lines cover. Where pieces meet the larger counts, not both.
std::vector<float> coverage_of(const std::vector<ContourPiece>& pieces, double width,
                               const Image& image) {
  std::vector<float> coverage(image.pixels.size() / 4, 0.0F);
  const double reach = 0.5 * width + 0.5;
  for (const ContourPiece& piece : pieces) {
    const auto& [a, b] = piece;
    const int left = static_cast<int>(std::floor(std::min(a[0], b[0]) - reach - 0.5)),
              right = static_cast<int>(std::ceil(std::max(a[0], b[0]) + reach)),
              top = static_cast<int>(std::floor(std::min(a[1], b[1]) - reach - 0.5)),
              bottom = static_cast<int>(std::ceil(std::max(a[1], b[1]) + reach));
    for (int y = std::max(0, top); y < std::min(image.height, bottom); ++y) {
      for (int x = std::max(0, left); x < std::min(image.width, right); ++x) {
        const double part = std::clamp(reach - distance_to(piece, x + 0.5, y + 0.5), 0.0, 1.0);
        float& covered =
            coverage[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                     static_cast<std::size_t>(x)];
        covered = std::max(covered, static_cast<float>(part));
      }
    }
  }
  return coverage;
}

void cover(const std::vector<float>& coverage, float light, float opacity, Image& image) {
  for (std::size_t i = 0; i < coverage.size(); ++i) {
    const float part = opacity * coverage[i];
    for (std::size_t c = 0; c < 3; ++c) {
      float& value = image.pixels[4 * i + c];
      value += part * (light - value);
    }
  }
}

}  // namespace

void draw_lines(const std::vector<ContourPiece>& pieces, double width, float light, Image& image) {
  cover(coverage_of(pieces, width, image), light, 1, image);
}

// White with a dark edge, which shows on any palette.
void draw_contours(const std::vector<ContourPiece>& pieces, double width, Image& image) {
  cover(coverage_of(pieces, 2.5 * width, image), 0, 0.6F, image);
  cover(coverage_of(pieces, width, image), 1, 1, image);
}

namespace {

constexpr Rgb no_value = {0.2F, 0.2F, 0.2F};  // a gray that few palettes have

std::string label_of(const Map& map) {
  std::string quantity = map.quantity;
  std::replace(quantity.begin(), quantity.end(), '_', ' ');
  std::string unit = map.unit;
  for (std::size_t at = unit.find("Msun"); at != std::string::npos; at = unit.find("Msun"))
    unit.replace(at, 4, "M_sun");
  return quantity + " [" + readable_unit(unit, true) + "]";
}

// What finishes pictures knows scenes and frames: these have one component, the map.
Scene scene_of_figure(const Map& map, const Scene& scene) {
  Scene figure;
  figure.image = scene.image;
  figure.image.gamma = 1;  // palettes appear as they are
  figure.finish = scene.finish;
  // The colors stand for values: light is not changed.
  figure.finish.exposure = 0;
  figure.finish.tone = ToneCurve::linear;
  figure.finish.white = 1;
  figure.finish.saturation = figure.finish.contrast = 1;
  figure.finish.inset.show = false;
  figure.finish.cross_fade = {};
  figure.finish.color_bar.show = true;
  figure.finish.color_bar.components.clear();
  // The sky has no lengths.
  const bool is_in_plane = map.shape == MapShape::plane;
  figure.finish.scale_bar.show = is_in_plane;
  if (figure.finish.scale_bar.length) *figure.finish.scale_bar.length *= map.length_factor;
  if (figure.finish.scale_bar.unit.empty()) figure.finish.scale_bar.unit = map.length_unit;
  return figure;
}

Frame frame_of_figure(const Map& map) {
  Frame frame;
  frame.width = map.width;
  frame.height = map.height;
  frame.crop = {0, 0, map.width, map.height};
  frame.projection = Projection::orthographic;
  frame.camera.pixels_per_length = 1 / map.pixel;
  return frame;
}

double percent_below(double limit, const Map& map) {
  const auto below = std::count_if(map.values.begin(), map.values.end(), [limit](float value) {
    return static_cast<double>(value) < limit;
  });
  return 100 * static_cast<double>(below) / static_cast<double>(map.values.size());
}

}  // namespace

Figure plan_figure(const Map& map, const MapSettings& settings) {
  const double error = std::max(map.tolerance, extended_tolerance) * map.value_floor;
  Figure figure = {map, MapColors(map.values, settings, map.value_floor, error),
                   load_palette(settings.palette), label_of(map), settings.contours};
  if (settings.contour_count > 0) figure.levels = figure.colors.even_values(settings.contour_count);
  return figure;
}

Image Figure::picture() const {
  Image image(map.width, map.height);
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    const double place = colors.place(static_cast<double>(map.values[i]));
    const auto color = sample_knots(palette.emission, place);
    for (std::size_t c = 0; c < 3; ++c) {
      image.pixels[4 * i + c] = std::isnan(place) ? no_value[c] : static_cast<float>(color[c]);
    }
    image.pixels[4 * i + 3] = 1;
  }
  return image;
}

std::vector<std::string> Figure::notes() const {
  const ColorRange& range = colors.range();
  const double negative = percent_below(0, map);
  std::vector<std::string> notes;
  if (range.begins_at_floor) {
    notes.push_back(fmt::format(
        "{:.2g} % of the map's pixels lie below its floor, {:.2g}, down to which the tolerance "
        "holds, and have the first color of the figure; map.min sets another limit",
        percent_below(range.low, map), range.low));
  }
  if (range.scaling == MapScaling::log && negative > 0) {
    notes.push_back(fmt::format(
        "{:.2g} % of the map's pixels lie below 0, where there is no logarithm, and have the first "
        "color of the figure; map.scaling = \"linear\" or \"asinh\" shows them",
        negative));
  }
  return notes;
}

void check_figure(const Scene& scene, const SnapshotInfo& snapshot) {
  (void)load_palette(scene.map.palette);
  check_color_limits(scene.map);
  Scene texts = scene_of_figure(Map(), scene);
  texts.finish.color_bar.show = false;  // it needs no component's field
  check_finish(texts, snapshot);
}

Image draw_figure(const Figure& figure, const Scene& scene, const SnapshotInfo& snapshot) {
  const Map& map = figure.map;
  const Scene finished = scene_of_figure(map, scene);
  const auto& labels = finished.finish.color_bar.labels;
  const ColorBarContent bar = {
      figure.palette.emission, labels.empty() ? figure.label : labels.front(),
      [&figure](int most, bool raised) { return figure.colors.ticks(most, raised); }};
  const PictureFinish finish(finished, frame_of_figure(map), snapshot, bar);
  Image image = figure.picture();
  for (const double level : figure.levels)
    draw_contours(contour_pieces(map, level),
                  std::max(1.0, std::min(map.width, map.height) / 700.0), image);
  finish.apply(image, finished.finish, [](const Frame&) { return Image(); });
  return image;
}

}  // namespace splotchcl
