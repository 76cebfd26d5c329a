#include <algorithm>
#include <cmath>

#include "finish/finish_picture.h"
#include "finish/labels.h"
#include "map/map_files.h"
#include "scene/scalar_map.h"
#include "scene/statistics.h"
#include "splotchcl/error.h"
#include "splotchcl/palette_file.h"

namespace splotchcl {
namespace {

constexpr Rgb no_value = {0.2F, 0.2F, 0.2F};  // a gray that few palettes have

std::vector<double> scaled_values(const Map& map, Scaling scaling) {
  std::vector<double> values;
  for (const float value : map.values) {
    const double s = scaled(static_cast<double>(value), scaling);
    if (std::isfinite(s)) values.push_back(s);
  }
  return values;
}

double limit(const std::optional<double>& said, const char* key, double percent,
             std::vector<double>& values, Scaling scaling) {
  if (!said) return percentile(values, percent / 100);
  const double s = scaled(*said, scaling);
  if (std::isfinite(s)) return s;
  throw UsageError(std::string("key map.") + key + ": found " + std::to_string(*said) +
                   ", expected a number > 0, since map.scaling is \"log\"");
}

ScalarMap decide_colors(const Map& map, const MapSettings& settings) {
  std::vector<double> values = scaled_values(map, settings.scaling);
  if (values.empty()) values = {0};
  ScalarMap colors;
  colors.scaling = settings.scaling;
  colors.minimum =
      limit(settings.minimum, "min", settings.percentiles[0], values, settings.scaling);
  colors.maximum =
      limit(settings.maximum, "max", settings.percentiles[1], values, settings.scaling);
  if (colors.maximum >= colors.minimum) return colors;
  throw UsageError("key map.max: found less than map.min, expected more");
}

Image colored(const Map& map, const ScalarMap& colors, const Palette& palette) {
  Image image(map.width, map.height);
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    const auto value = static_cast<double>(map.values[i]);
    const auto color = sample_knots(palette.emission, normalized(value, colors));
    for (std::size_t c = 0; c < 3; ++c) {
      image.pixels[4 * i + c] = std::isnan(value) ? no_value[c] : static_cast<float>(color[c]);
    }
    image.pixels[4 * i + 3] = 1;
  }
  return image;
}

// What finishes pictures knows scenes and frames: these have one component, the map.
Scene scene_of_figure(const Map& map, const Scene& scene) {
  Scene figure;
  figure.image = scene.image;
  figure.image.gamma = 1;  // palettes appear as they are
  figure.finish = scene.finish;
  figure.finish.inset.show = false;
  figure.finish.cross_fade = {};
  figure.finish.color_bar.show = true;
  figure.finish.color_bar.components.clear();
  if (figure.finish.color_bar.labels.empty()) {
    std::string quantity = map.quantity;
    std::replace(quantity.begin(), quantity.end(), '_', ' ');
    figure.finish.color_bar.labels = {quantity + " [" + readable_unit(map.unit, true) + "]"};
  }
  figure.finish.scale_bar.show = true;
  if (figure.finish.scale_bar.unit.empty()) figure.finish.scale_bar.unit = map.length_unit;
  Component component;
  component.name = "map";
  component.color.field = "map";
  figure.components = {component};
  return figure;
}

Frame frame_of_figure(const Map& map, const ScalarMap& colors, const Palette& palette) {
  Frame frame;
  frame.width = map.width;
  frame.height = map.height;
  frame.crop = {0, 0, map.width, map.height};
  frame.projection = Projection::orthographic;
  frame.camera.pixels_per_length = 1 / map.pixel;
  DrawnComponent component;
  component.name = "map";
  component.color = colors;
  component.palette = palette;
  frame.components.push_back(std::move(component));
  return frame;
}

}  // namespace

Image numbers_as_image(const Map& map) {
  Image image(map.width, map.height);
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    image.pixels[4 * i] = map.values[i];
    if (!map.effective_particles.empty()) image.pixels[4 * i + 1] = map.effective_particles[i];
    image.pixels[4 * i + 3] = 1;
  }
  return image;
}

Image draw_figure(const Map& map, const Scene& scene, const SnapshotInfo& snapshot) {
  const ScalarMap colors = decide_colors(map, scene.map);
  const Palette palette = load_palette(scene.map.palette);
  const PictureFinish finish(scene_of_figure(map, scene), frame_of_figure(map, colors, palette),
                             snapshot);
  Image image = colored(map, colors, palette);
  finish.apply(image, [](const Frame&) { return Image(); });
  return image;
}

}  // namespace splotchcl
