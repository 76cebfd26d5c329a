#include "generate/universe_model.h"

#include <algorithm>
#include <cmath>

#include "generate/gas.h"
#include "generate/random.h"
#include "parallel/for_blocks.h"
#include "scene/constants.h"
#include "splotchcl/error.h"
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

namespace {

constexpr double largest_birth_radius = 0.2;  // of haloes
constexpr double overdensity = 200;           // of a halo, over the mean
constexpr int map_side = 192;

double radius_of_halo(const Halo& halo) {
  return halo.birth_radius / std::cbrt(overdensity);
}

// 1e10 solar masses/h, dark matter included.
double mass(const Halo& halo) {
  return 4 * pi / 3 * std::pow(halo.birth_radius * universe_box, 3) * cosmology::matter *
         cosmology::critical_density;
}

double circular_speed(const Halo& halo) {
  return std::sqrt(gravitational_constant * mass(halo) / (radius_of_halo(halo) * universe_box));
}

// The smallest hold some thirty particles, and are born of peaks that the waves resolve.
std::vector<Halo> make_haloes(const Web& web, double spacing) {
  std::vector<Halo> haloes = find_haloes([&](double radius) { return web.contrast(radius); },
                                         largest_birth_radius, std::clamp(2 * spacing, 0.02, 0.05));
  if (haloes.empty()) {
    throw UsageError("this seed makes a universe in which nothing has collapsed; choose another");
  }
  for (Halo& halo : haloes)
    halo.center = web.displaced(halo.birthplace);
  return haloes;
}

double spacing_of(std::uint64_t gas) {
  return 1 / std::cbrt(static_cast<double>(gas));
}

std::vector<Vec3> make_tracers(std::uint64_t count, Random& random) {
  std::vector<Vec3> birthplaces;
  for (std::uint64_t i = 0; i < count; ++i)
    birthplaces.push_back(even_place(i, random, 0.5 * spacing_of(count)));
  return birthplaces;
}

SharpenedWeb sharpened(const Web& web, const std::vector<Vec3>& tracers) {
  constexpr std::size_t places_at_once = 4096;
  std::vector<Vec3> places(tracers.size());
  std::vector<double> parts(tracers.size());
  for_blocks(places.size(), places_at_once, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      places[i] = web.displaced(tracers[i]);
      parts[i] = web.sharpness(tracers[i]);
    }
  });
  return {std::move(places), parts};
}

// Of every halo.
std::vector<HaloInterior> make_interiors(const Web& web, const std::vector<Halo>& haloes,
                                         double spacing, Random& random) {
  std::vector<HaloInterior> interiors;
  for (const Halo& halo : haloes) {
    std::array<Vec3, 3> differences;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Vec3 before = halo.birthplace, after = halo.birthplace;
      before.a[axis] -= halo.birth_radius;
      after.a[axis] += halo.birth_radius;
      differences[axis] = web.displaced(after) - web.displaced(before);
      differences[axis].a[axis] -= 2 * halo.birth_radius;
    }
    const double particles = 4 * pi / 3 * std::pow(halo.birth_radius / spacing, 3);
    interiors.emplace_back(shape_of_halo(differences, 2 * halo.birth_radius), particles, random);
  }
  return interiors;
}

// Gas born in a halo's ball: the inner part fills the profile; towards the rim it still
// streams in along the web.
void settle(Universe::Gas& gas, const Halo& halo, const HaloInterior& interior,
            const Vec3& birthplace, Random& random) {
  const double distance = boost::qvm::mag(periodic_difference(halo.birthplace, birthplace));
  const double enclosed = std::min(1.0, std::pow(distance / halo.birth_radius, 3));
  const HaloInterior::Placed settled = interior.gas(std::min(1.0, 1.25 * enclosed), random);
  const Vec3 streaming = periodic_difference(halo.center, gas.place);
  const double share = 1 - smoothstep((enclosed - 0.4) / 0.6);
  gas.place =
      halo.center + settled.place * (share * radius_of_halo(halo)) + streaming * (1 - share);
  gas.speed += settled.speed * (share * circular_speed(halo));
  gas.heat = 0.75 * share * std::pow(circular_speed(halo), 2) * settled.heat;
}

// Stars by halo: almost in proportion to its mass.
std::vector<double> cumulated_star_shares(const std::vector<Halo>& haloes) {
  std::vector<double> shares;
  double sum = 0;
  for (const Halo& halo : haloes)
    shares.push_back(sum += std::pow(mass(halo), 0.8));
  return shares;
}

}  // namespace

double web_energy(double contrast) {
  constexpr double at_mean = 60;
  return at_mean * std::pow(contrast, 0.6);
}

double mean_gas_density() {
  return cosmology::baryons * cosmology::critical_density;
}

Vec3 into_box(Vec3 place) {
  for (int axis = 0; axis < 3; ++axis) {
    const double inside = (place.a[axis] - std::floor(place.a[axis])) * universe_box;
    // What single precision rounds up to the far face is the near face.
    place.a[axis] = static_cast<float>(inside) < static_cast<float>(universe_box) ? inside : 0;
  }
  return place;
}

Universe::Universe(std::uint64_t gas, std::uint64_t tracers, Random& random)
    : web_(universe_box, random),
      haloes_(make_haloes(web_, spacing_of(gas))),
      tracers_(make_tracers(tracers, random)),
      sharpened_(sharpened(web_, tracers_)),
      interiors_(make_interiors(web_, haloes_, spacing_of(gas), random)),
      map_(haloes_, map_side),
      star_shares_(cumulated_star_shares(haloes_)) {
  for (Halo& halo : haloes_)
    halo.center = sharpened_.moved(halo.center, 1) + web_.strayed(halo.birthplace);
}

Vec3 Universe::moved(const Vec3& birthplace) const {
  return sharpened_.moved(web_.displaced(birthplace), web_.sharpness(birthplace)) +
         web_.strayed(birthplace);
}

Universe::Gas Universe::gas(const Vec3& birthplace, const Vec3& moved_to, Random& random) const {
  Gas gas;
  gas.place = moved_to;
  gas.speed = periodic_difference(birthplace, moved_to) *
              (universe_box * cosmology::hubble * cosmology::growth_rate);
  const int halo = map_.at(birthplace);
  if (halo != HaloMap::none) {
    const auto index = static_cast<std::size_t>(halo);
    settle(gas, haloes_[index], interiors_[index], birthplace, random);
  }
  return gas;
}

Universe::Star Universe::star(Random& random) const {
  const auto chosen = std::upper_bound(star_shares_.begin(), star_shares_.end() - 1,
                                       random.uniform() * star_shares_.back());
  const auto index = static_cast<std::size_t>(chosen - star_shares_.begin());
  const Halo& halo = haloes_[index];
  const HaloInterior::Placed placed = interiors_[index].star(random);
  Star star;
  star.place = halo.center + placed.place * radius_of_halo(halo);
  star.speed = placed.speed * circular_speed(halo);
  // Large haloes formed their stars early, and their centres earlier still.
  const double outwards = std::min(1.0, boost::qvm::mag(placed.place));
  const double latest = std::clamp(0.9 - 0.12 * std::log10(mass(halo)) + 0.3 * outwards, 0.1, 1.0);
  star.age = static_cast<float>(latest * std::sqrt(random.uniform()));
  return star;
}

}  // namespace splotchcl
