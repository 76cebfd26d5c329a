#include "generate/gas.h"
#include "generate/random.h"
#include "generate/universe_model.h"
#include "parallel/for_blocks.h"
#include "splotchcl/generate.h"

namespace splotchcl {

GeneratedSnapshot generate_universe(const GenerateSettings& settings) {
  const ParticleShares shares = share_particles(settings);
  Random random(settings.seed);
  const Universe universe(shares.gas, shares.gas, random);
  const std::vector<Vec3>& birthplaces = universe.tracers();
  std::vector<Vec3> moved(birthplaces.size());
  constexpr std::size_t places_at_once = 4096;
  for_blocks(moved.size(), places_at_once, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      moved[i] = universe.moved(birthplaces[i]);
  });

  GeneratedSnapshot snapshot;
  snapshot.box_size = universe_box;
  std::vector<double> heats;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    const Universe::Gas gas = universe.gas(birthplaces[i], moved[i], random);
    snapshot.gas.add(into_box(gas.place), gas.speed);
    heats.push_back(gas.heat);
  }
  for (std::uint64_t i = 0; i < shares.stars; ++i) {
    const Universe::Star star = universe.star(random);
    snapshot.stars.add(into_box(star.place), star.speed);
    snapshot.stars.age.push_back(star.age);
  }

  const double mean_density = mean_gas_density();
  const double gas_mass = mean_density * universe_box * universe_box * universe_box;
  set_masses(snapshot, gas_mass, stars_per_gas * gas_mass);
  for (std::size_t i = 0; i < heats.size(); ++i) {
    const double contrast = static_cast<double>(snapshot.gas.density[i]) / mean_density;
    snapshot.gas.internal_energy.push_back(static_cast<float>(web_energy(contrast) + heats[i]));
  }
  return snapshot;
}

}  // namespace splotchcl
