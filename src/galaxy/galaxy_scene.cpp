#include <fmt/format.h>

#include "galaxy/disk_types.h"
#include "splotchcl/galaxy.h"

namespace splotchcl {
namespace {

// In the quotes of TOML.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + '"';
}

std::string types_of_light(const Galaxy& galaxy) {
  std::string types;
  for (const auto& [name, particles] :
       {std::pair("gas", &galaxy.gas), std::pair("disk", &galaxy.disk),
        std::pair("bulge", &galaxy.bulge), std::pair("stars", &galaxy.clusters)}) {
    if (particles->count() > 0) types += fmt::format("{}\"{}\"", types.empty() ? "" : ", ", name);
  }
  return types;
}

}  // namespace

std::string galaxy_scene(const Galaxy& galaxy, const std::filesystem::path& snapshot) {
  const double distance = 1.4 * galaxy.size_kpc;
  std::string scene = fmt::format(R"(# A galaxy made from a picture, tilted by 60 degrees.
snapshot = {}

[image]
size = [1280, 720]
gamma = 2.2

[camera]
position = [0, {:.4g}, {:.4g}]  # kpc
look_at = [0, 0, 0]
sky = [0, 0, 1]
field_of_view = 40

# Seen from its edge the disk is far brighter than from above: white is what is 2.8 times as bright
# as the picture's white, and the curve lifts what is less.
[finish]
tone = "filmic"
exposure = 1.5
white = 8

[[component]]
name = "light"
types = [{}]
color = {{ vector = "Color" }}
weight = "mass"
reference_column = 1
absorption = "none"
)",
                                  quoted(snapshot.string()), -0.866 * distance, 0.5 * distance,
                                  types_of_light(galaxy));
  if (galaxy.dust.count() > 0) {
    scene += fmt::format(R"(
# Gives off no light, and absorbs blue most.
[[component]]
name = "dust"
types = {}
color = {{ vector = "Opacity" }}
weight = "mass"
reference_column = 1
brightness = 0
absorption = 1
)",
                         dust_type);
  }
  return scene;
}

}  // namespace splotchcl
