#include <utility>

#include "formats/hdf5/gadget_hdf5_writer.h"
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

}  // namespace splotchcl
