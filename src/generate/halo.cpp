#include <algorithm>
#include <cmath>

#include "generate/gas.h"
#include "generate/halo_profile.h"
#include "generate/random.h"
#include "scene/constants.h"
#include "splotchcl/generate.h"

namespace splotchcl {
namespace {

// Lengths in kpc/h, speeds in km/s, masses in 1e10 solar masses/h.
constexpr double virial_radius = 100;
constexpr double halo_speed = 170;  // of circular orbits, the same at every radius
constexpr double disc_scale = 4, disc_height = 0.25, disc_edge = 25;
constexpr double bulge_scale = 0.7;
constexpr int arms = 2;
constexpr double arm_pitch = 0.28;  // tangent of the pitch angle
constexpr int satellites = 24;
constexpr double gas_mass = 4, star_mass = 3;

struct Galaxy {
  // The axes of its disc, inclined to every axis of the picture.
  Vec3 first = {{0.7071067811865475, 0.7071067811865475, 0}};
  Vec3 second = {{-0.4082482904638630, 0.4082482904638630, 0.8164965809277260}};
  Vec3 normal = {{0.5773502691896258, -0.5773502691896258, 0.5773502691896258}};
};

Vec3 in_disc(double along_first, double along_second, double height) {
  static const Galaxy galaxy;
  return galaxy.first * along_first + galaxy.second * along_second + galaxy.normal * height;
}

// Of an exponential disc, cut at its edge: the mass within x scales is 1 - (1 + x) exp(-x),
// which is the law of a sum of two exponential variates.
double disc_radius(double scale, Random& random) {
  for (;;) {
    const double radius =
        -scale * (std::log(1 - random.uniform()) + std::log(1 - random.uniform()));
    if (radius < disc_edge) return radius;
  }
}

// How dense the disc is there, from 0 to 1: ridges along logarithmic spirals.
double arm_strength(double radius, double angle, double sharpness) {
  const double phase = arms * (angle - std::log(radius / disc_scale + 0.1) / arm_pitch);
  return std::exp(sharpness * (std::cos(phase) - 1));
}

struct Placed {
  Vec3 place, speed;
};

// `sharpness` of the arms; `between`, from 0 to 1, is the density between them.
Placed place_in_disc(double scale, double height, double sharpness, double between,
                     Random& random) {
  for (;;) {
    const double radius = disc_radius(scale, random);
    const double angle = random.uniform(0, 2 * pi);
    const double density = between + (1 - between) * arm_strength(radius, angle, sharpness);
    if (random.uniform() > density) continue;
    // Gas flares outwards. Speeds rise towards the flat rotation curve.
    const double above = height * (1 + radius / (2 * disc_scale)) * random.normal();
    const double speed = halo_speed * std::sqrt(radius / (radius + 1));
    const double c = std::cos(angle), s = std::sin(angle);
    return {in_disc(radius * c, radius * s, above),
            in_disc(-speed * s, speed * c, 0) + random.normal_vector(0.05 * halo_speed)};
  }
}

Placed place_in_ball(const Vec3& center, const Vec3& speed, double radius, double dispersion,
                     Random& random) {
  return {center + random.direction() * radius, speed + random.normal_vector(dispersion)};
}

// Of a Hernquist sphere, cut at ten scales.
double bulge_radius(double scale, Random& random) {
  const double root = std::sqrt(random.uniform(0, 100.0 / 121));
  return scale * root / (1 - root);
}

struct Satellite {
  Vec3 center, speed;
  double radius = 0;  // its virial radius
  double share = 0;   // of all the satellites' mass, with those before it
};

std::vector<Satellite> make_satellites(Random& random) {
  const NfwProfile profile(5);
  std::vector<Satellite> all;
  double sum = 0;
  for (int i = 0; i < satellites; ++i) {
    const double mass = 1 / (1.5 + i);  // of the i-th largest
    const double distance = virial_radius * profile.radius(random.uniform(0.15, 1));
    Satellite satellite;
    satellite.center = random.direction() * distance;
    satellite.speed = random.normal_vector(halo_speed * M_SQRT1_2);
    satellite.radius = 10 * std::cbrt(mass);
    satellite.share = sum += mass;
    all.push_back(satellite);
  }
  for (Satellite& satellite : all)
    satellite.share /= sum;
  return all;
}

Placed place_in_satellite(const std::vector<Satellite>& all, double extent, Random& random) {
  static const NfwProfile profile(10);
  const double share = random.uniform();
  const auto chosen =
      std::find_if(all.begin(), all.end() - 1, [&](const Satellite& s) { return share < s.share; });
  const double radius = extent * chosen->radius * profile.radius(random.uniform());
  return place_in_ball(chosen->center, chosen->speed, radius, 30, random);
}

void add(GeneratedParticles& particles, const Placed& placed) {
  particles.add(placed.place, placed.speed);
}

void add_gas(GeneratedParticles& gas, const std::vector<Satellite>& all, std::uint64_t count,
             Random& random) {
  const NfwProfile profile(4);
  for (std::uint64_t i = 0; i < count; ++i) {
    const double kind = random.uniform();
    double energy = 0;  // (km/s)^2: the disc's gas is cold, the halo's at virial temperature
    if (kind < 0.7) {
      add(gas, place_in_disc(disc_scale * 1.3, disc_height, 4, 0.12, random));
      energy = 150;
    } else if (kind < 0.85) {
      const double radius = virial_radius * profile.radius(random.uniform());
      add(gas, place_in_ball({{0, 0, 0}}, {{0, 0, 0}}, radius, halo_speed * M_SQRT1_2, random));
      energy = 0.75 * halo_speed * halo_speed * (1.2 - 0.6 * radius / virial_radius);
    } else {
      add(gas, place_in_satellite(all, 1, random));
      energy = 1500;
    }
    gas.internal_energy.push_back(static_cast<float>(energy * std::exp(0.25 * random.normal())));
  }
}

void add_stars(GeneratedParticles& stars, const std::vector<Satellite>& all, std::uint64_t count,
               Random& random) {
  for (std::uint64_t i = 0; i < count; ++i) {
    const double kind = random.uniform();
    double born_after = 0, born_before = 0.4;  // scale factors
    if (kind < 0.45) {                         // young stars, where the gas is
      add(stars, place_in_disc(disc_scale, disc_height, 5, 0.05, random));
      born_after = 0.7;
      born_before = 1;
    } else if (kind < 0.7) {  // the old disc
      add(stars, place_in_disc(disc_scale * 0.8, 2 * disc_height, 1, 0.6, random));
      born_before = 0.8;
    } else if (kind < 0.92) {
      add(stars, place_in_ball({{0, 0, 0}}, {{0, 0, 0}}, bulge_radius(bulge_scale, random),
                               0.6 * halo_speed, random));
    } else {
      add(stars, place_in_satellite(all, 0.3, random));
      born_before = 0.9;
    }
    stars.age.push_back(static_cast<float>(random.uniform(born_after, born_before)));
  }
}

}  // namespace

GeneratedSnapshot generate_halo(const GenerateSettings& settings) {
  const ParticleShares shares = share_particles(settings);
  Random random(settings.seed);
  const std::vector<Satellite> all = make_satellites(random);
  GeneratedSnapshot snapshot;
  add_gas(snapshot.gas, all, shares.gas, random);
  add_stars(snapshot.stars, all, shares.stars, random);
  set_masses(snapshot, gas_mass, star_mass);
  return snapshot;
}

}  // namespace splotchcl
