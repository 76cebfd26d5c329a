#include "map/shape.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "cells/sky_grid.h"
#include "common/words.h"
#include "splotchcl/error.h"
#include "splotchcl/map.h"

namespace splotchcl {
namespace {

using Asked = std::pair<MapShape, const char*>;

std::vector<Asked> asked_shapes(const MapSettings& settings) {
  std::vector<Asked> asked;
  if (settings.channels > 0) asked.emplace_back(MapShape::velocities, "channels");
  if (settings.healpix > 0) asked.emplace_back(MapShape::healpix, "healpix");
  if (settings.voxels[0] > 0) asked.emplace_back(MapShape::voxels, "voxels");
  if (settings.profile > 0) asked.emplace_back(MapShape::profile, "profile");
  if (!settings.histogram.empty()) asked.emplace_back(MapShape::histogram, "histogram");
  if (settings.view == MapView::sky) asked.emplace_back(MapShape::sky, "view = \"sky\"");
  return asked;
}

void refuse_key(const std::string& key, const std::string& expected) {
  throw UsageError(fmt::format("key map.{}: found it in such a map, expected {}", key, expected));
}

void check_shell(const MapSettings& settings, MapShape shape) {
  if (!settings.shell) return;
  if (!is_around_the_center(shape))
    refuse_key("shell", "it beside map.healpix, map.profile or a sky");
  const auto [low, high] = *settings.shell;
  const bool is_open = shape == MapShape::profile ? low > 0 : low >= 0;
  if (is_open && high > low) return;
  throw UsageError(fmt::format("key map.shell: found {} to {}, expected rising radii, from {} on",
                               low, high, shape == MapShape::profile ? "more than 0" : "0"));
}

void check_sphere(const MapSettings& settings, MapShape shape) {
  if (settings.healpix > 0 && !is_healpix_side(settings.healpix)) {
    throw UsageError(fmt::format("key map.healpix: found {}, expected a power of two from 1 to {}",
                                 settings.healpix, most_healpix_sides));
  }
  if (!settings.tile) return;
  if (shape != MapShape::healpix && shape != MapShape::sky)
    refuse_key("tile", "it beside map.healpix or a sky");
  if (!settings.shell) refuse_key("tile", "map.shell beside it: images have no end");
}

void check_histogram(const MapSettings& settings) {
  if (settings.histogram.empty() || settings.histogram.size() == 2) return;
  throw UsageError(
      fmt::format("key map.histogram: found {} fields, expected two", settings.histogram.size()));
}

const char* words_of(MapShape shape) {
  switch (shape) {
    case MapShape::healpix:
      return "a sphere";
    case MapShape::sky:
      return "a sky";
    case MapShape::voxels:
      return "voxels";
    case MapShape::profile:
      return "a profile";
    case MapShape::histogram:
      return "a histogram";
    case MapShape::plane:
    case MapShape::velocities:
      break;
  }
  return "a plane";
}

const char* in_place_of_integral(MapShape shape) {
  const bool is_seen = shape == MapShape::healpix || shape == MapShape::sky;
  return is_seen ? "a mean: sums on a sphere are per solid angle, not along lines"
                 : "a mean weighted by volume, which times a cell's volume is the integral in it";
}

// What has no meaning there, and what has.
void check_quantity_of_cells(const MapSettings& settings, MapShape shape) {
  const auto refuse = [shape](const char* key, const char* expected, const char* found = "it") {
    throw UsageError(fmt::format("key map.{}: found {} beside {}, expected {}", key, found,
                                 words_of(shape), expected));
  };
  if (settings.slice)
    refuse("slice", "a map in a plane: other cells have what lies in all of them");
  if (settings.noise)
    refuse("noise",
           "a map in a plane; map.quantity = \"counts\" tells how many particles cells have");
  if (settings.statistic == MapStatistic::integral)
    refuse("statistic", in_place_of_integral(shape), "\"integral\"");
  if (!settings.distance.empty()) refuse("distance", "a map in a plane");
  if (settings.depth || settings.lengths_with_units.count("depth") > 0)
    refuse("depth", "map.shell, or a selection");
}

}  // namespace

bool is_around_the_center(MapShape shape) {
  return shape == MapShape::healpix || shape == MapShape::sky || shape == MapShape::profile;
}

bool is_made_of_cells(MapShape shape) {
  return shape != MapShape::plane && shape != MapShape::velocities;
}

MapShape shape_of(const MapSettings& settings) {
  const std::vector<Asked> asked = asked_shapes(settings);
  if (asked.size() > 1) {
    throw UsageError(fmt::format("keys map.{} and map.{}: found both, expected one of them",
                                 asked[0].second, asked[1].second));
  }
  const MapShape shape = asked.empty() ? MapShape::plane : asked.front().first;
  check_shell(settings, shape);
  check_sphere(settings, shape);
  check_histogram(settings);
  if (is_made_of_cells(shape)) check_quantity_of_cells(settings, shape);
  return shape;
}

const Component& component_of_map(const Scene& scene) {
  if (scene.components.empty()) {
    throw UsageError("the scene has no component, expected at least one; add a [[component]]");
  }
  if (scene.map.component.empty()) return scene.components.front();
  std::vector<std::string> names;
  for (const Component& component : scene.components) {
    if (component.name == scene.map.component) return component;
    names.push_back(component.name);
  }
  throw UsageError("key map.component: found \"" + scene.map.component +
                   "\", expected the name of a component" +
                   did_you_mean(nearest_name(scene.map.component, names)));
}

Scene scene_of_numbers(const Scene& scene, const Component& component) {
  Scene one = scene;
  one.components = {component};
  Component& only = one.components.front();
  only.color = {};
  only.intensity = {};
  only.color_vector.clear();
  one.finish = {};
  one.sort = {};
  return one;
}

double MapAxis::edge(int i) const {
  const double part = static_cast<double>(i) / cells;
  if (i == cells) return last;
  return is_logarithmic ? first * std::pow(last / first, part) : first + part * (last - first);
}

int Map::planes() const {
  if (shape == MapShape::velocities) return velocity->channels;
  return shape == MapShape::voxels ? axes[2].cells : 1;
}

}  // namespace splotchcl
