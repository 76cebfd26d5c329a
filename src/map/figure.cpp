#include "map/figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "finish/finish_picture.h"
#include "finish/ticks.h"
#include "map/map_colors.h"
#include "splotchcl/palette_file.h"
#include "splotchcl/plan.h"

namespace splotchcl {
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
  figure.finish.scale_bar.show = true;
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
