#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "generate/gas.h"
#include "generate/halo_profile.h"
#include "scene/constants.h"
#include "splotchcl/generate.h"

namespace splotchcl {
namespace {

// Lengths in kpc/h, speeds in km/s, masses in 1e10 solar masses/h.
constexpr double cluster_radius = 1500, total_mass = 6e4;
constexpr double farthest = 4 * cluster_radius;
constexpr int streams = 6, groups = 7, waves = 12;
constexpr double cluster_gas_mass = 0.15 * total_mass, cluster_star_mass = 0.02 * total_mass;
constexpr double cold = 80;  // (km/s)^2: what has not met the hot gas

double circular_speed() {
  return std::sqrt(gravitational_constant * total_mass / cluster_radius);
}

// Cold gas that falls in along the web, in strands that wind around each other.
struct Stream {
  Vec3 outwards, aside, upwards;
  double end = 0, width = 0, bend = 0, winding = 0;

  // The middle of a strand, each of which goes a way of its own.
  Vec3 place(double distance, double phase) const {
    const double along = std::log(distance / cluster_radius);
    const double bent = bend * along + 0.06 * std::sin(5 * along + phase);
    const double apart = thickness(distance) * (0.5 + 0.5 * std::sin(3.1 * along + 2.7 * phase));
    const double angle = winding * along + phase + 0.7 * std::sin(4.3 * along + 1.9 * phase);
    return (outwards * std::cos(bent) + aside * std::sin(bent)) * distance +
           (aside * std::cos(angle) + upwards * std::sin(angle)) * apart;
  }
  double thickness(double distance) const {
    return width * std::pow(distance / cluster_radius, 0.8);
  }
};

// A smaller cluster, in a stream.
struct Group {
  Vec3 center, speed;
  double radius = 0;
  HaloInterior interior;
};

struct Surroundings {
  explicit Surroundings(double particles, Random& random);

  std::vector<Stream> all_streams;
  std::vector<Group> all_groups;
  HaloInterior cluster;
  std::array<Vec3, waves> wave;  // of what warms and cools the hot gas
  std::array<double, waves> phase = {};
};

Stream make_stream(Random& random) {
  Stream stream;
  stream.outwards = random.direction();
  stream.aside = boost::qvm::normalized(boost::qvm::cross(stream.outwards, random.direction()));
  stream.upwards = boost::qvm::cross(stream.outwards, stream.aside);
  stream.end = cluster_radius * random.uniform(0.25, 0.7);
  stream.width = cluster_radius * random.uniform(0.07, 0.16);
  stream.bend = random.uniform(-0.5, 0.5);
  stream.winding = random.uniform(0.4, 1.6);
  return stream;
}

// Longest along the thickest streams.
HaloShape shape_along(const std::vector<Stream>& all) {
  std::array<Vec3, 3> differences = {};
  for (const Stream& stream : all) {
    for (std::size_t i = 0; i < 3; ++i)
      differences[i] += stream.outwards * (stream.width * stream.outwards.a[i]);
  }
  return shape_of_halo(differences, 1);
}

std::vector<Stream> make_streams(Random& random) {
  std::vector<Stream> all;
  for (int i = 0; i < streams; ++i)
    all.push_back(make_stream(random));
  return all;
}

Surroundings::Surroundings(double particles, Random& random)
    : all_streams(make_streams(random)), cluster(shape_along(all_streams), particles, random) {
  for (int i = 0; i < groups; ++i) {
    const Stream& stream = all_streams[static_cast<std::size_t>(i % streams)];
    const double distance = cluster_radius * random.uniform(1.1, 3.2);
    const double radius = cluster_radius * random.uniform(0.12, 0.3);
    all_groups.push_back({stream.place(distance, random.uniform(0, 2 * pi)),
                          stream.outwards * (-0.8 * circular_speed()), radius,
                          HaloInterior(HaloShape(), 0.03 * particles, random)});
  }
  for (std::size_t i = 0; i < waves; ++i) {
    wave[i] = random.direction() * (2 * pi / cluster_radius * random.uniform(0.8, 4));
    phase[i] = random.uniform(0, 2 * pi);
  }
}

struct ClusterGas {
  Vec3 place, speed;
  double energy = 0;
};

ClusterGas place_body(const Surroundings& around, Random& random) {
  const HaloInterior::Placed gas = around.cluster.gas(random.uniform(), random);
  const double speed = circular_speed();
  ClusterGas placed = {gas.place * cluster_radius, gas.speed * (0.3 * speed), 0};
  double warmth = 0;
  for (std::size_t i = 0; i < waves; ++i)
    warmth += std::sin(boost::qvm::dot(around.wave[i], placed.place) + around.phase[i]);
  placed.energy = 0.75 * speed * speed * gas.heat * std::exp(0.16 * warmth) + cold;
  return placed;
}

ClusterGas place_in_stream(const Surroundings& around, Random& random) {
  const Stream& stream =
      around.all_streams[static_cast<std::size_t>(random.uniform() * streams) % streams];
  constexpr int strands = 5;
  // The first has most of the gas.
  const double strand = std::floor(std::pow(random.uniform(), 1.7) * strands);
  const double distance = stream.end * std::pow(farthest / stream.end, random.uniform()) *
                          std::exp(0.15 * random.normal());
  const double apart = std::abs(random.normal());
  const Vec3 aside = random.direction() * (0.55 * stream.thickness(distance) * apart);
  // Its outside mixes with what is hot, and its end dissolves.
  const double mixed = std::exp(2.2 * std::min(2.0, apart) - 0.2) *
                       (1 + 40 * std::exp(-6 * (distance / stream.end - 1)));
  return {stream.place(distance, 2.4 * strand) + aside,
          stream.outwards * (-0.7 * circular_speed()) + random.normal_vector(60),
          cold * (1 + mixed) * std::exp(0.3 * random.normal())};
}

ClusterGas place_in_group(const Surroundings& around, Random& random) {
  const Group& group =
      around.all_groups[static_cast<std::size_t>(random.uniform() * groups) % groups];
  const HaloInterior::Placed gas = group.interior.gas(random.uniform(), random);
  const double speed = circular_speed() * group.radius / cluster_radius;
  return {group.center + gas.place * group.radius, group.speed + gas.speed * speed,
          0.75 * speed * speed * gas.heat + cold};
}

// Falls in from all sides, and is warmed as it comes near.
ClusterGas place_outside(Random& random) {
  const double distance = farthest * std::pow(random.uniform(), 0.55);
  const Vec3 outwards = random.direction();
  return {outwards * distance, outwards * (-0.5 * circular_speed()),
          cold * (1 + 60 * std::exp(-distance / cluster_radius)) * std::exp(0.3 * random.normal())};
}

void add_gas(GeneratedParticles& gas, const Surroundings& around, std::uint64_t count,
             Random& random) {
  for (std::uint64_t i = 0; i < count; ++i) {
    const double kind = random.uniform();
    const ClusterGas placed = kind < 0.5    ? place_body(around, random)
                              : kind < 0.75 ? place_in_stream(around, random)
                              : kind < 0.85 ? place_in_group(around, random)
                                            : place_outside(random);
    gas.add(placed.place, placed.speed);
    gas.internal_energy.push_back(static_cast<float>(placed.energy));
  }
}

void add_stars(GeneratedParticles& stars, const Surroundings& around, std::uint64_t count,
               Random& random) {
  for (std::uint64_t i = 0; i < count; ++i) {
    const bool is_in_group = random.uniform() < 0.2;
    const Group& group =
        around.all_groups[static_cast<std::size_t>(random.uniform() * groups) % groups];
    const HaloInterior::Placed star =
        is_in_group ? group.interior.star(random) : around.cluster.star(random);
    const double radius = is_in_group ? group.radius : cluster_radius;
    const double speed = circular_speed() * radius / cluster_radius;
    const Vec3 center = is_in_group ? group.center : Vec3{{0, 0, 0}};
    stars.add(center + star.place * radius, star.speed * speed);
    // Those in the middle are the oldest.
    const double latest = std::clamp(0.35 + 0.5 * boost::qvm::mag(star.place), 0.1, 1.0);
    stars.age.push_back(static_cast<float>(latest * std::sqrt(random.uniform())));
  }
}

}  // namespace

GeneratedSnapshot generate_cluster(const GenerateSettings& settings) {
  const ParticleShares shares = share_particles(settings);
  Random random(settings.seed);
  const Surroundings around(0.5 * static_cast<double>(shares.gas), random);
  GeneratedSnapshot snapshot;
  add_gas(snapshot.gas, around, shares.gas, random);
  add_stars(snapshot.stars, around, shares.stars, random);
  set_masses(snapshot, cluster_gas_mass, cluster_star_mass);
  return snapshot;
}

}  // namespace splotchcl
