#include "generate/gas.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>

#include "smoothing/smoothing_lengths.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

// Fewer do not have enough neighbours for a smoothing length.
constexpr std::uint64_t least_gas = 1000;

std::vector<float> smoothing_lengths(const GeneratedParticles& particles, double box_size) {
  const Column position(nullptr, particles.position.data(), particles.position.size());
  const std::optional<BoxSides> period = box_of({box_size});
  const Column lengths = find_smoothing_lengths(position, particles.count(), period);
  return {lengths.data(), lengths.data() + lengths.size()};
}

void set_mass(GeneratedParticles& particles, double total) {
  if (particles.count() == 0) return;
  particles.mass = static_cast<float>(total / static_cast<double>(particles.count()));
}

void find_density(GeneratedSnapshot& snapshot) {
  for (GeneratedParticles* particles : {&snapshot.gas, &snapshot.stars}) {
    if (particles->count() == 0) continue;
    particles->smoothing_length = smoothing_lengths(*particles, snapshot.box_size);
  }
  set_densities(snapshot.gas);
}

}  // namespace

ParticleShares share_particles(const GenerateSettings& settings, std::uint64_t most) {
  if (settings.particles < least_gas || settings.particles > most) {
    throw UsageError(fmt::format("particles: found {}, expected a whole number from {} to {}",
                                 settings.particles, least_gas, most));
  }
  if (!(settings.star_fraction >= 0 && settings.star_fraction <= 0.9)) {
    throw UsageError(
        fmt::format("stars: found {}, expected a fraction of the particles from 0 to 0.9",
                    settings.star_fraction));
  }
  ParticleShares shares;
  shares.stars = static_cast<std::uint64_t>(
      std::llround(settings.star_fraction * static_cast<double>(settings.particles)));
  shares.gas = settings.particles - shares.stars;
  return shares;
}

void set_densities(GeneratedParticles& gas) {
  const std::vector<float>& lengths = gas.smoothing_length;
  const Column density = densities_from_smoothing_lengths(
      Column::uniform(gas.mass), Column(nullptr, lengths.data(), lengths.size()), lengths.size());
  gas.density.assign(density.data(), density.data() + density.size());
}

void set_masses(GeneratedSnapshot& snapshot, double of_gas, double of_stars) {
  set_mass(snapshot.gas, of_gas);
  set_mass(snapshot.stars, of_stars);
  find_density(snapshot);
}

}  // namespace splotchcl
