#include <algorithm>
#include <cmath>

#include "generate/gas.h"
#include "generate/halo_profile.h"
#include "generate/random.h"
#include "generate/web.h"
#include "parallel/for_blocks.h"
#include "scene/constants.h"
#include "splotchcl/error.h"
#include "splotchcl/generate.h"

namespace splotchcl {
namespace {

constexpr double box = 50000;  // kpc/h
constexpr double critical_density = cosmology::critical_density;
constexpr double largest_birth_radius = 0.2;  // of haloes
constexpr double overdensity = 200;           // of a halo, over the mean
constexpr double stars_per_gas = 0.1;         // in mass
constexpr double web_energy = 60;             // (km/s)^2, of gas at the mean density

double radius_of_halo(const Halo& halo) {
  return halo.birth_radius / std::cbrt(overdensity);
}

// 1e10 solar masses/h, dark matter included.
double mass(const Halo& halo) {
  return 4 * pi / 3 * std::pow(halo.birth_radius * box, 3) * cosmology::matter * critical_density;
}

double circular_speed(const Halo& halo) {
  return std::sqrt(gravitational_constant * mass(halo) / (radius_of_halo(halo) * box));
}

Vec3 into_box(Vec3 place) {
  for (int axis = 0; axis < 3; ++axis) {
    const double inside = (place.a[axis] - std::floor(place.a[axis])) * box;
    // What single precision rounds up to the far face is the near face.
    place.a[axis] = static_cast<float>(inside) < static_cast<float>(box) ? inside : 0;
  }
  return place;
}

struct HaloGas {
  Vec3 place, speed;
  double heat = 0;  // the part of its internal energy from falling into a halo, (km/s)^2
};

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
void settle(HaloGas& gas, const Halo& halo, const HaloInterior& interior, const Vec3& birthplace,
            Random& random) {
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

// Where the web moves gas; the haloes go along.
std::vector<Vec3> move_along(const Web& web, const std::vector<Vec3>& birthplaces,
                             std::vector<Halo>& haloes) {
  constexpr std::size_t places_at_once = 4096;
  std::vector<Vec3> places(birthplaces.size());
  for_blocks(places.size(), places_at_once, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      places[i] = web.displaced(birthplaces[i]);
  });
  sharpen_web(places, web.sharpness(birthplaces), haloes);
  for_blocks(places.size(), places_at_once, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      places[i] += web.strayed(birthplaces[i]);
  });
  for (Halo& halo : haloes)
    halo.center += web.strayed(halo.birthplace);
  return places;
}

// `places` are those to which the web alone has moved the gas.
std::vector<HaloGas> place_gas(const std::vector<Vec3>& birthplaces,
                               const std::vector<Vec3>& places, const std::vector<Halo>& haloes,
                               const std::vector<HaloInterior>& interiors, Random& random) {
  const HaloMap map(haloes, 192);
  std::vector<HaloGas> all;
  for (std::size_t i = 0; i < places.size(); ++i) {
    HaloGas gas;
    gas.place = places[i];
    gas.speed = periodic_difference(birthplaces[i], places[i]) *
                (box * cosmology::hubble * cosmology::growth_rate);
    const int halo = map.at(birthplaces[i]);
    if (halo != HaloMap::none) {
      const auto index = static_cast<std::size_t>(halo);
      settle(gas, haloes[index], interiors[index], birthplaces[i], random);
    }
    all.push_back(gas);
  }
  return all;
}

// Stars by halo: almost in proportion to its mass.
std::vector<double> cumulated_star_shares(const std::vector<Halo>& haloes) {
  std::vector<double> shares;
  double sum = 0;
  for (const Halo& halo : haloes)
    shares.push_back(sum += std::pow(mass(halo), 0.8));
  return shares;
}

void add_stars(GeneratedParticles& stars, const std::vector<Halo>& haloes,
               const std::vector<HaloInterior>& interiors, std::uint64_t count, Random& random) {
  const std::vector<double> shares = cumulated_star_shares(haloes);
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto chosen =
        std::upper_bound(shares.begin(), shares.end() - 1, random.uniform() * shares.back());
    const auto index = static_cast<std::size_t>(chosen - shares.begin());
    const Halo& halo = haloes[index];
    const HaloInterior::Placed star = interiors[index].star(random);
    stars.add(into_box(halo.center + star.place * radius_of_halo(halo)),
              star.speed * circular_speed(halo));
    // Large haloes formed their stars early, and their centres earlier still.
    const double outwards = std::min(1.0, boost::qvm::mag(star.place));
    const double latest =
        std::clamp(0.9 - 0.12 * std::log10(mass(halo)) + 0.3 * outwards, 0.1, 1.0);
    stars.age.push_back(static_cast<float>(latest * std::sqrt(random.uniform())));
  }
}

}  // namespace

GeneratedSnapshot generate_universe(const GenerateSettings& settings) {
  const ParticleShares shares = share_particles(settings);
  Random random(settings.seed);
  const Web web(box, random);
  const double spacing = 1 / std::cbrt(static_cast<double>(shares.gas));
  std::vector<Halo> haloes = make_haloes(web, spacing);
  std::vector<Vec3> birthplaces;
  for (std::uint64_t i = 0; i < shares.gas; ++i)
    birthplaces.push_back(even_place(i, random, 0.5 * spacing));
  const std::vector<Vec3> places = move_along(web, birthplaces, haloes);
  const std::vector<HaloInterior> interiors = make_interiors(web, haloes, spacing, random);
  const std::vector<HaloGas> placed = place_gas(birthplaces, places, haloes, interiors, random);

  GeneratedSnapshot snapshot;
  snapshot.box_size = box;
  for (const HaloGas& gas : placed)
    snapshot.gas.add(into_box(gas.place), gas.speed);
  add_stars(snapshot.stars, haloes, interiors, shares.stars, random);

  const double mean_density = cosmology::baryons * critical_density;
  const double gas_mass = mean_density * box * box * box;
  set_masses(snapshot, gas_mass, stars_per_gas * gas_mass);
  for (std::size_t i = 0; i < placed.size(); ++i) {
    const double contrast = static_cast<double>(snapshot.gas.density[i]) / mean_density;
    snapshot.gas.internal_energy.push_back(
        static_cast<float>(web_energy * std::pow(contrast, 0.6) + placed[i].heat));
  }
  return snapshot;
}

}  // namespace splotchcl
