#include <fmt/format.h>

#include <utility>

#include "formats/hdf5/gadget_hdf5_writer.h"
#include "galaxy/matter.h"
#include "splotchcl/galaxy.h"

namespace splotchcl {
namespace {

// Columns that borrow the galaxy's memory.
WrittenType written_type(int type, const GalaxyParticles& particles, std::uint64_t first_id,
                         const char* color) {
  const auto column = [](const std::vector<float>& values) {
    return Column(nullptr, values.data(), values.size());
  };
  WrittenType written;
  written.type = type;
  written.count = particles.count();
  written.fields = {{"Coordinates", 3, column(particles.position)},
                    {"Velocities", 3, column(particles.velocity)},
                    {"Masses", 1, column(particles.mass)},
                    {"SmoothingLength", 1, column(particles.smoothing_length)},
                    {color, 3, column(particles.color)},
                    {"OrbitAxis", 3, column(particles.orbit_axis)},
                    {"OrbitRadius", 1, column(particles.orbit_radius)}};
  for (std::uint64_t i = 0; i < written.count; ++i)
    written.ids.push_back(first_id + i);
  return written;
}

}  // namespace

void write_galaxy(const std::filesystem::path& path, const Galaxy& galaxy) {
  WrittenSnapshot snapshot;
  std::uint64_t next_id = 1;
  for (const auto& [type, particles] :
       {std::pair(0, &galaxy.gas), std::pair(2, &galaxy.disk), std::pair(3, &galaxy.bulge),
        std::pair(4, &galaxy.clusters)}) {
    snapshot.types.push_back(written_type(type, *particles, next_id, "Color"));
    next_id += particles->count();
  }
  if (galaxy.dust.count() > 0)
    snapshot.types.push_back(written_type(5, galaxy.dust, next_id, "Opacity"));
  write_gadget_hdf5(path, snapshot);
}

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
exposure = 2
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
