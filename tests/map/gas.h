#pragma once

#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "snapshot/memory_snapshot.h"
#include "splotchcl/map.h"
#include "splotchcl/reference.h"
#include "splotchcl/renderer.h"

// Gas that was never a file, and maps of it.
namespace splotchcl::test {

struct Gas {
  std::vector<float> position, h, mass, density, temperature, velocity;

  void add(const Vec3& place, float size, float m, float t, const Vec3& v = {{0, 0, 0}},
           float rho = 1) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      position.push_back(static_cast<float>(place.a[axis]));
      velocity.push_back(static_cast<float>(v.a[axis]));
    }
    h.push_back(size);
    mass.push_back(m);
    density.push_back(rho);
    temperature.push_back(t);
  }
  MemorySnapshot snapshot() const {
    MemorySnapshot made;
    made.add(0, "position", position, 3);
    made.add(0, "velocity", velocity, 3);
    made.add(0, "smoothing_length", h);
    made.add(0, "mass", mass);
    made.add(0, "density", density);
    made.add(0, "temperature", temperature);
    return made;
  }
};

// Of every size between the limits, logarithmically, in a cube around the origin.
inline Gas random_gas(int count, double half_side, float least_h, float most_h, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(0, 1);
  Gas gas;
  for (int i = 0; i < count; ++i) {
    const Vec3 place = {{half_side * (2 * part(random) - 1), half_side * (2 * part(random) - 1),
                         half_side * (2 * part(random) - 1)}};
    const auto h =
        static_cast<float>(static_cast<double>(least_h) *
                           std::pow(static_cast<double>(most_h / least_h), part(random)));
    gas.add(place, h, static_cast<float>(1 + part(random)),
            static_cast<float>(std::pow(10, 3 + 4 * part(random))),
            {{part(random) - 0.5, part(random) - 0.5, part(random) - 0.5}},
            static_cast<float>(1 + part(random)));
  }
  return gas;
}

inline double sum(const Map& map) {
  return std::accumulate(map.values.begin(), map.values.end(), 0.0);
}

inline Gas one_particle(const Vec3& place, float size = 0.5F, float mass = 1) {
  Gas gas;
  gas.add(place, size, mass, 100);
  return gas;
}

// 64 x 48 pixels of one length each, around the origin.
inline Scene map_scene() {
  Scene scene;
  scene.image.width = 64;
  scene.image.height = 48;
  scene.tolerance = 0;
  Component component;
  component.name = "gas";
  scene.components = {component};
  scene.map.center = Vec3{{0, 0, 0}};
  scene.map.width = 64;
  return scene;
}

// By the reference renderer.
inline Map map_of(const Scene& scene, const Snapshot& snapshot,
                  std::vector<std::string>* notes = nullptr) {
  std::vector<std::string> untold;
  return draw_map(
      scene, snapshot, [](const Frame& frame) { return reference::render(frame).to_float(); },
      notes == nullptr ? untold : *notes);
}

inline Map map_on_device(Renderer& renderer, const Scene& scene, const Snapshot& snapshot) {
  std::vector<std::string> untold;
  return draw_map(
      scene, snapshot, [&renderer](const Frame& frame) { return renderer.render(frame); }, untold);
}

inline const double sigma_of_h = KernelSettings().width;

inline double total_of(const std::vector<float>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

inline float at(const Map& map, int x, int y) {
  return map.values[static_cast<std::size_t>(y * map.width + x)];
}

}  // namespace splotchcl::test
