#include "adversary/exact_map.h"

#include "adversary/places.h"
#include "testing.h"

namespace splotchcl::adversary {
namespace {

struct MapParticle {
  float x, y, z, h, mass, value;
  double copies;
};

double value_of(const Place& place, std::size_t group, const Trial& trial) {
  const double sign = trial.signs > 0 && group % 2 == 1 ? -1 : 1;
  const double hue = place.group->hue;
  return sign *
         (trial.value_decades > 0 ? std::pow(10, trial.value_decades * (hue - 0.5)) : hue + 0.1);
}

// From the plane through the middle, in sigma.
double height_of(std::size_t i) {
  return 0.7 * (static_cast<double>(i * 7 % 11) / 5.5 - 1);
}

std::vector<MapParticle> map_particles(const Trial& trial) {
  std::vector<MapParticle> particles;
  const std::vector<Place> places = places_of(trial);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Place& place = places[i];
    const auto group = static_cast<std::size_t>(place.group - trial.groups.data());
    MapParticle particle;
    particle.x = static_cast<float>(place.x - 0.5 * trial.width);
    particle.y = static_cast<float>(0.5 * trial.height - place.y);
    particle.z = static_cast<float>(place.sigma * height_of(i));
    particle.h = static_cast<float>(place.sigma / KernelSettings().width);
    particle.mass = static_cast<float>(place.group->peak * pi * place.sigma * place.sigma);
    particle.value = static_cast<float>(value_of(place, group, trial));
    particle.copies = place.copies;
    particles.push_back(particle);
  }
  return particles;
}

// Of a Gaussian around 0 what lies between both, which keeps its digits far outside.
double part_between(double low, double high) {
  if (low > 0) return 0.5 * (std::erfc(low) - std::erfc(high));
  if (high < 0) return 0.5 * (std::erfc(-high) - std::erfc(-low));
  return 0.5 * (std::erf(high) - std::erf(low));
}

// Of one copy.
double weight_of(const MapParticle& particle, double sigma, const Trial& trial) {
  const double z = static_cast<double>(particle.z) / sigma;
  const double in_plane = trial.slice > 0 ? std::exp(-z * z) / (std::sqrt(pi) * sigma) : 1;
  return static_cast<double>(particle.mass) * in_plane;
}

std::vector<double> parts_along(double center, double sigma, int pixels) {
  std::vector<double> parts;
  for (int i = 0; i < pixels; ++i) {
    const double low = i - 0.5 * pixels - center;
    parts.push_back(part_between(low / sigma, (low + 1) / sigma));
  }
  return parts;
}

}  // namespace

Scene map_scene_of(const Trial& trial) {
  Scene scene;
  scene.image.width = whole(trial.width);
  scene.image.height = whole(trial.height);
  scene.tolerance = trial.tolerance;
  Component component;
  component.name = "gas";
  scene.components = {component};
  scene.map.center = Vec3{{0, 0, 0}};
  scene.map.width = trial.width;
  scene.map.floor = trial.map_floor;
  scene.map.slice = trial.slice > 0;
  if (trial.map == MapKind::column) return scene;
  scene.map.quantity = "temperature";
  scene.map.statistic = trial.map == MapKind::mean         ? MapStatistic::mean
                        : trial.map == MapKind::dispersion ? MapStatistic::dispersion
                                                           : MapStatistic::integral;
  scene.map.weight = trial.slice > 0 ? "volume" : "mass";
  if (trial.map == MapKind::integral) scene.map.weight = "";
  return scene;
}

test::MemorySnapshot map_snapshot_of(const Trial& trial) {
  std::vector<float> position, h, mass, density, value;
  for (const MapParticle& particle : map_particles(trial)) {
    for (double copy = 0; copy < particle.copies; ++copy) {
      position.insert(position.end(), {particle.x, particle.y, particle.z});
      h.push_back(particle.h);
      mass.push_back(particle.mass);
      density.push_back(1);
      value.push_back(particle.value);
    }
  }
  test::MemorySnapshot snapshot;
  snapshot.add(0, "position", std::move(position), 3);
  snapshot.add(0, "smoothing_length", std::move(h));
  snapshot.add(0, "mass", std::move(mass));
  snapshot.add(0, "density", std::move(density));
  snapshot.add(0, "temperature", std::move(value));
  return snapshot;
}

double brightest_particle(const Trial& trial, const OfValue& of_value) {
  double brightest = 0;
  for (const MapParticle& particle : map_particles(trial)) {
    const double sigma = KernelSettings().width * static_cast<double>(particle.h);
    const double light = weight_of(particle, sigma, trial) / std::max(1.0, pi * sigma * sigma);
    brightest =
        std::max(brightest, light * std::abs(of_value(static_cast<double>(particle.value))));
  }
  return brightest;
}

ExactMap exact_map(const Trial& trial, const OfValue& of_value) {
  const int width = whole(trial.width), height = whole(trial.height);
  ExactMap map(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (const MapParticle& particle : map_particles(trial)) {
    const double sigma = KernelSettings().width * static_cast<double>(particle.h);
    const double weight = particle.copies * weight_of(particle, sigma, trial);
    const double value = of_value(static_cast<double>(particle.value));
    const auto across = parts_along(static_cast<double>(particle.x), sigma, width);
    const auto along = parts_along(-static_cast<double>(particle.y), sigma, height);
    for (std::size_t i = 0; i < map.size(); ++i) {
      const std::size_t columns = across.size(), x = i % columns, y = i / columns;
      const double part = weight * across[x] * along[y];
      map[i].weight += part;
      (value > 0 ? map[i].above : map[i].below) += part * std::abs(value);
      const double distance =
          std::hypot(static_cast<double>(x) + 0.5 - 0.5 * width - static_cast<double>(particle.x),
                     static_cast<double>(y) + 0.5 - 0.5 * height + static_cast<double>(particle.y));
      if (distance < 6 * sigma - 1) continue;
      map[i].open_weight += part;
      map[i].open_both += part * std::abs(value);
    }
  }
  return map;
}

}  // namespace splotchcl::adversary
