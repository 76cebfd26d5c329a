#include "load/component_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "splotchcl/palette_file.h"

namespace splotchcl {
namespace {

// Of the brightest color of a palette: less is dark.
constexpr float dark_part = 0.25F;

float brightest_channel(const Rgb& color) {
  return *std::max_element(color.begin(), color.end());
}

}  // namespace

Palette choose_palette(const Component& component) {
  Palette palette;
  if (component.color_vector.empty()) {
    palette = load_palette(component.palette);
  } else {
    palette.name = "white";
    palette.emission = {Rgb{1, 1, 1}};
  }
  const std::string& other = component.absorption_palette;
  const bool is_the_same = component.color_vector.empty() && other == component.palette;
  if (other.empty() || is_the_same) return palette;
  const Palette absorbing = load_palette(other);
  palette.absorption = absorbing.has_own_absorption() ? absorbing.absorption : absorbing.emission;
  return palette;
}

std::optional<std::string> tell_dark_color(const Component& component, const Palette& palette) {
  if (!component.color.field.empty() || !component.color_vector.empty()) return std::nullopt;
  float brightest = 0;
  for (const Rgb& color : palette.emission)
    brightest = std::max(brightest, brightest_channel(color));
  if (brightest_channel(palette.emission.front()) >= dark_part * brightest) return std::nullopt;
  return fmt::format(
      "without color.field all of its particles take the first color of the palette {}, which is "
      "dark; name a field, or a palette that begins with a brighter color",
      palette.name);
}

namespace {

// Lengths of the snapshot are scaled with it; a fixed size is a length of the scene.
double drawn_size_factor(const Component& component) {
  return component.size_fixed ? component.size_factor
                              : component.size_factor * component.placement.scale;
}

}  // namespace

WeightModel ComponentReader::weight() const {
  return component_.weight.value_or(fields_.masses_are_known() ? WeightModel::mass
                                                               : WeightModel::constant);
}

void ComponentReader::select() {
  if (is_selected_) return;
  fields_.select();
  is_selected_ = true;
}

std::size_t ComponentReader::count() {
  select();
  return fields_.count();
}

const Column& ComponentReader::read_once(std::optional<Column>& column, const std::string& field,
                                         const char* key) {
  if (!column) {
    select();
    column = field.empty() ? Column() : fields_.scalars(field, key);
  }
  return *column;
}

const Column& ComponentReader::color() {
  return read_once(color_, component_.color.field, "color.field");
}

const Column& ComponentReader::intensity() {
  return read_once(intensity_, component_.intensity.field, "intensity.field");
}

Column ComponentReader::weights(WeightModel weight) const {
  switch (weight) {
    case WeightModel::mass:
      return fields_.masses();
    case WeightModel::density:
      return fields_.scalars("density", "weight = \"density\"");
    case WeightModel::constant:
      break;
  }
  return {};
}

DrawnComponent ComponentReader::drawn(WeightModel weight) {
  select();
  DrawnComponent drawn;
  drawn.name = fields_.name();
  drawn.size_factor = drawn_size_factor(component_);
  drawn.brightness = component_.brightness;
  drawn.absorption = component_.absorption;
  drawn.palette = choose_palette(component_);
  drawn.weight = weight;
  drawn.particles_per_drawn = fields_.particles_per_drawn();

  Particles& particles = drawn.particles;
  particles.count = fields_.count();
  particles.origin = fields_.origin();
  particles.position = fields_.positions();
  particles.smoothing_length = fields_.smoothing_lengths();
  particles.weight = fields_.with_factors(weights(weight));
  particles.boxes = fields_.boxes();
  particles.color = color();
  if (!component_.color_vector.empty()) {
    particles.color_vector = fields_.vectors(component_.color_vector, "color.vector");
  }
  particles.intensity = intensity();
  if (sort_.by == SortOrder::By::field) {
    particles.sort_field = fields_.scalars(sort_.field, "sort.by");
  }
  return drawn;
}

}  // namespace splotchcl
