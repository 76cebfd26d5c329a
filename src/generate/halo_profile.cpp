#include "generate/halo_profile.h"

#include <algorithm>
#include <cmath>

namespace splotchcl {
namespace {

constexpr double gas_concentration = 7, smaller_concentration = 9, star_concentration = 12;
constexpr double star_extent = 0.35;  // of the virial radius
constexpr double mass_in_smaller = 0.16;
constexpr double most_smaller = 90;
constexpr double least_gas_of_halo = 12;  // of gas, in a smaller halo
constexpr double fall_of_mass = 1.05;     // of the i-th largest: i to the power of minus this

Vec3 thermal(double speed, Random& random) {
  return random.normal_vector(speed * M_SQRT1_2);
}

Vec3 in_ball(double radius, Random& random) {
  return random.direction() * radius;
}

// An ellipsoid in any direction.
HaloShape random_shape(Random& random) {
  const Vec3 axis = random.direction();
  const double stretch = std::exp(0.25 * random.normal());
  HaloShape shape;
  // 1 across the axis and `stretch` along it.
  for (std::size_t i = 0; i < 3; ++i)
    shape.rows[i] += axis * ((stretch - 1) * axis.a[i]);
  return shape;
}

}  // namespace

HaloShape shape_of_halo(const std::array<Vec3, 3>& differences, double distance) {
  // Symmetric and without a trace: only directions matter.
  std::array<Vec3, 3> tide;
  double trace = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j)
      tide[i].a[j] = (differences[i].a[j] + differences[j].a[i]) / (2 * distance);
    trace += tide[i].a[i];
  }
  double square = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    tide[i].a[i] -= trace / 3;
    square += boost::qvm::dot(tide[i], tide[i]);
  }
  HaloShape shape;
  if (!(square > 0)) return shape;
  constexpr double stretch = 0.42;  // axes of about 1.3, 1 and 0.7
  for (std::size_t i = 0; i < 3; ++i)
    shape.rows[i] += tide[i] * (stretch / std::sqrt(square));
  return shape;
}

HaloInterior::HaloInterior(const HaloShape& shape, double particles, Random& random)
    : shape_(shape) {
  double sum = 0;
  for (int i = 1; i <= most_smaller; ++i)
    sum += std::pow(i, -fall_of_mass);
  double all = 0, star_all = 0;
  for (int i = 1; i <= most_smaller; ++i) {
    const double mean = mass_in_smaller * std::pow(i, -fall_of_mass) / sum;
    if (mean * particles < least_gas_of_halo) break;
    Smaller smaller = make_smaller(mean * std::exp(0.4 * random.normal()), random);
    smaller.share = all += smaller.mass;
    smaller.star_share = star_all += std::pow(smaller.mass, 0.8);
    all_.push_back(smaller);
  }
  gas_in_smaller_ = all;
}

HaloInterior::Smaller HaloInterior::make_smaller(double mass, Random& random) const {
  Smaller smaller;
  smaller.mass = mass;
  // Less concentrated than the body: what comes close to the middle does not last.
  const double distance = 1.25 * std::pow(random.uniform(0.03, 1), 0.6);
  smaller.center = shape_.stretched(in_ball(distance, random));
  smaller.speed = thermal(1, random);
  smaller.shape = random_shape(random);
  smaller.radius = std::cbrt(mass) * (0.3 + 0.5 * distance);
  return smaller;
}

const HaloInterior::Smaller& HaloInterior::choose(double Smaller::*share, Random& random) const {
  const double wanted = random.uniform() * (all_.back().*share);
  return *std::upper_bound(all_.begin(), all_.end() - 1, wanted,
                           [share](double value, const Smaller& s) { return value < s.*share; });
}

HaloInterior::Placed HaloInterior::gas(double enclosed, Random& random) const {
  static const NfwProfile body(gas_concentration), small(smaller_concentration);
  const double noise = std::exp(0.2 * random.normal());
  if (!all_.empty() && random.uniform() < gas_in_smaller_) {
    const Smaller& smaller = choose(&Smaller::share, random);
    const double radius = smaller.radius * small.radius(random.uniform());
    // A tail of what its gas lost on its way lies behind it.
    const double behind = random.uniform() < 0.4 ? -std::log(1 - random.uniform()) : 0;
    Placed placed;
    placed.place = smaller.center + smaller.shape.stretched(in_ball(radius, random)) -
                   smaller.speed * (1.2 * smaller.radius * behind);
    placed.speed = smaller.speed + thermal(std::cbrt(smaller.mass), random);
    placed.heat = (std::pow(smaller.mass, 2.0 / 3) + 0.1 * std::min(1.0, behind)) * noise;
    return placed;
  }
  // Its rim is not sharp.
  const double radius = body.radius(enclosed) * std::exp(0.2 * random.normal());
  return {shape_.stretched(in_ball(radius, random)), thermal(1, random),
          std::max(0.3, 1.3 - 0.7 * radius) * noise};
}

HaloInterior::Placed HaloInterior::star(Random& random) const {
  static const NfwProfile profile(star_concentration);
  const double kind = random.uniform();
  const double radius = profile.radius(random.uniform());
  constexpr double between = 0.15, in_smaller = 0.5;
  if (kind < between)
    return {shape_.stretched(in_ball(0.75 * radius, random)), thermal(1, random), 0};
  if (all_.empty() || kind > between + in_smaller)
    return {shape_.stretched(in_ball(0.6 * star_extent * radius, random)), thermal(0.8, random), 0};
  const Smaller& smaller = choose(&Smaller::star_share, random);
  Vec3 place =
      smaller.center + smaller.shape.stretched(in_ball(0.3 * smaller.radius * radius, random));
  // Some are lost before and behind it, along its way.
  constexpr double lost = 0.2;
  if (random.uniform() < lost) place += smaller.speed * (1.5 * smaller.radius * random.normal());
  return {place, smaller.speed + thermal(std::cbrt(smaller.mass), random), 0};
}

}  // namespace splotchcl
