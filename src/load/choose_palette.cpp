#include "load/choose_palette.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

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

}  // namespace splotchcl
