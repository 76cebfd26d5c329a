#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "splotchcl/vector.h"

namespace splotchcl {

// Particles that are made up rather than simulated, for demonstrations and tests.
// Units are Gadget's: kpc/h, 1e10 solar masses/h, km/s.
struct GenerateSettings {
  std::uint64_t particles = 200000;  // gas and stars together
  double star_fraction = 0.15;       // of the particles, 0 to 0.9
  std::uint64_t seed = 1;            // the same seed gives the same particles
};

// Particles of one kind, all of one mass; what a kind does not have is empty.
struct GeneratedParticles {
  std::vector<float> position, velocity;        // 3 per particle
  std::vector<float> smoothing_length;          // the kernel's support radius
  float mass = 0;                               // of each
  std::vector<float> density, internal_energy;  // gas only
  // Stars only: the scale factor of the universe at their birth, 0 to 1.
  std::vector<float> age;

  std::uint64_t count() const { return position.size() / 3; }
  void add(const Vec3& place, const Vec3& speed) {
    for (int axis = 0; axis < 3; ++axis) {
      position.push_back(static_cast<float>(place.a[axis]));
      velocity.push_back(static_cast<float>(speed.a[axis]));
    }
  }
};

struct GeneratedSnapshot {
  double box_size = 0;  // the side of the periodic box; 0: not periodic
  GeneratedParticles gas, stars;
};

// A periodic box of cosmic web and haloes, today. Throws UsageError for settings out of
// range.
GeneratedSnapshot generate_universe(const GenerateSettings& settings);

// A spiral galaxy with its satellites in a halo of hot gas, around the origin, seen
// inclined along every axis. Throws UsageError likewise.
GeneratedSnapshot generate_halo(const GenerateSettings& settings);

// A cluster of galaxies around the origin: hot gas with smaller haloes in it, groups that fall in,
// cold streams of gas that reach into it, galaxies, and stars between them. Throws UsageError
// likewise.
GeneratedSnapshot generate_cluster(const GenerateSettings& settings);

// Gadget format 2, little-endian. Appears under its name only when complete. Throws
// DataError.
void write_gadget2(const std::filesystem::path& path, const GeneratedSnapshot& snapshot);

}  // namespace splotchcl
