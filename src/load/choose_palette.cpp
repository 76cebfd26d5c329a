#include "load/choose_palette.h"

#include <string>

#include "splotchcl/palette_file.h"

namespace splotchcl {

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

}  // namespace splotchcl
