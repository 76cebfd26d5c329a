#include "synthetic.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "scene/statistics.h"

namespace splotchcl::bench {
namespace {

constexpr double pi = 3.14159265358979323846;

struct ParticleArrays {
  std::vector<float> position, smoothing_length, color;

  void add(const Vec3& place, double h, double value) {
    for (int axis = 0; axis < 3; ++axis)
      position.push_back(static_cast<float>(place.a[axis]));
    smoothing_length.push_back(static_cast<float>(h));
    color.push_back(static_cast<float>(value));
  }
};

// The radius that holds 64 neighbours where there are so many particles per volume.
double smoothing_length_at(double density) {
  return std::cbrt(64 * 3 / (4 * pi * density));
}

// A halo whose density falls as r^-2, flat in the core.
void add_halo(ParticleArrays& arrays, std::size_t count, double total, Random& random) {
  // 200 times the mean density of a box of `total` particles.
  const double radius = std::cbrt(static_cast<double>(count) * 3 / (4 * pi * 200 * total));
  const Vec3 center = {{random.uniform(), random.uniform(), random.uniform()}};
  const double core = 0.02 * radius;
  for (std::size_t i = 0; i < count; ++i) {
    const double r = radius * random.uniform();
    const double from_core = std::max(r, core);
    const double density = static_cast<double>(count) / (4 * pi * radius * from_core * from_core);
    arrays.add(center + random.direction() * r, smoothing_length_at(density), 1 - 0.7 * r / radius);
  }
}

// How many particles each halo gets: from 50 upwards, the number of haloes falling with
// the square of their size, and none beyond a hundredth of the universe.
std::vector<std::size_t> halo_sizes(std::size_t total, Random& random) {
  std::vector<std::size_t> sizes;
  const double largest = std::max(100.0, 0.01 * static_cast<double>(total));
  while (total > 0) {
    const double size = 50 / (1 - random.uniform() * (1 - 50 / largest));
    sizes.push_back(std::min(total, static_cast<std::size_t>(size)));
    total -= sizes.back();
  }
  return sizes;
}

template <class T>
std::vector<T> reordered(const std::vector<T>& values, std::size_t width,
                         const std::vector<std::uint32_t>& order) {
  std::vector<T> result;
  result.reserve(values.size());
  for (const std::uint32_t i : order) {
    for (std::size_t k = 0; k < width; ++k)
      result.push_back(values[width * i + k]);
  }
  return result;
}

void shuffle(ParticleArrays& arrays, Random& random) {
  std::vector<std::uint32_t> order(arrays.color.size());
  std::iota(order.begin(), order.end(), 0u);
  for (std::size_t i = order.size(); i > 1; --i) {
    std::swap(order[i - 1],
              order[static_cast<std::size_t>(random.uniform(0, static_cast<double>(i)))]);
  }
  arrays.position = reordered(arrays.position, 3, order);
  arrays.smoothing_length = reordered(arrays.smoothing_length, 1, order);
  arrays.color = reordered(arrays.color, 1, order);
}

Particles to_particles(ParticleArrays arrays) {
  Particles particles;
  particles.count = arrays.color.size();
  particles.position = Column::owning(std::move(arrays.position));
  particles.smoothing_length = Column::owning(std::move(arrays.smoothing_length));
  particles.color = Column::owning(std::move(arrays.color));
  return particles;
}

}  // namespace

double Random::logarithmic(double low, double high) {
  return low * std::pow(high / low, uniform());
}

Vec3 Random::direction() {
  const double z = uniform(-1, 1), angle = uniform(0, 2 * pi);
  const double across = std::sqrt(1 - z * z);
  return {{across * std::cos(angle), across * std::sin(angle), z}};
}

Particles make_universe(const UniverseSetup& setup) {
  Random random(setup.seed);
  ParticleArrays arrays;
  const auto total = static_cast<double>(setup.particles);
  const std::size_t in_haloes = setup.particles / 2;
  for (const std::size_t count : halo_sizes(in_haloes, random))
    add_halo(arrays, count, total, random);
  const double h = smoothing_length_at(total / 2);
  while (arrays.color.size() < setup.particles) {
    arrays.add({{random.uniform(), random.uniform(), random.uniform()}},
               h * random.uniform(0.8, 1.2), random.uniform(0, 0.3));
  }
  if (setup.order == FileOrder::shuffled) shuffle(arrays, random);
  return to_particles(std::move(arrays));
}

Frame universe_frame(const Particles& particles, int width, int height,
                     double field_of_view_degrees) {
  Frame frame;
  frame.width = width;
  frame.height = height;
  frame.crop = {0, 0, width, height};
  Camera camera;
  camera.position = {{0.5, -1.7, 0.9}};
  camera.look_at = {{0.5, 0.5, 0.5}};
  camera.sky = {{0, 0, 1}};
  camera.field_of_view_degrees = field_of_view_degrees;
  frame.camera = make_camera_frame(camera, width, height);
  DrawnComponent component;
  component.name = "gas";
  component.particles = particles;
  component.particles.weight = Column::uniform(1);
  component.palette = three_colors();
  component.reference_column = find_reference_column(component, frame).value_or(1);
  frame.components = {component};
  return frame;
}

DrawnComponent make_clouds(const CloudSetup& setup) {
  Random random(setup.seed);
  ParticleArrays arrays;
  std::vector<float> mass;
  for (std::size_t i = 0; i < setup.count; ++i) {
    const Vec3 place = {{random.uniform(-0.55, 0.55) * setup.width,
                         random.uniform(-0.55, 0.55) * setup.height,
                         random.uniform(setup.depth_low, setup.depth_high)}};
    const double sigma = random.logarithmic(setup.sigma_low, setup.sigma_high);
    const double column = random.logarithmic(setup.column_low, setup.column_high);
    arrays.add(place, sigma, random.uniform());
    mass.push_back(static_cast<float>(column * pi * sigma * sigma));
  }
  DrawnComponent component;
  component.particles = to_particles(std::move(arrays));
  component.particles.weight = Column::owning(std::move(mass));
  component.palette = three_colors();
  return component;
}

Frame cloud_frame(int width, int height, std::vector<DrawnComponent> components) {
  Frame frame;
  frame.width = width;
  frame.height = height;
  frame.crop = {0, 0, width, height};
  frame.projection = Projection::orthographic;
  frame.camera.position = {{0, 0, 0}};
  frame.camera.right = {{1, 0, 0}};
  frame.camera.down = {{0, 1, 0}};
  frame.camera.forward = {{0, 0, 1}};
  frame.camera.look_at_distance = 1;
  frame.camera.pixels_per_length = 1;
  frame.camera.focal_pixels = 1;
  frame.camera.center_x = 0.5 * width;
  frame.camera.center_y = 0.5 * height;
  frame.kernel.width = 1;  // h is sigma
  frame.components = std::move(components);
  return frame;
}

void set_light(Frame& frame, LightPlan light) {
  for (DrawnComponent& component : frame.components) {
    switch (light) {
      case LightPlan::emission:
        component.absorption = {Absorption::Kind::none, 0};
        break;
      case LightPlan::proportional:
        component.absorption = {Absorption::Kind::as_emission, 0};
        break;
      case LightPlan::ordered:
        component.absorption = {Absorption::Kind::gray, 0.2};
        if (&component != &frame.components.front()) {
          component.absorption = {Absorption::Kind::none, 0};
        }
        break;
    }
  }
}

Palette three_colors() {
  Palette palette;
  palette.name = "three colours";
  palette.emission = {Rgb{0.1f, 0.2f, 0.9f}, Rgb{0.5f, 0.9f, 0.5f}, Rgb{1.0f, 0.4f, 0.1f}};
  return palette;
}

Palette warm_white() {
  Palette palette;
  palette.name = "warm white";
  palette.emission = {Rgb{1.0f, 0.9f, 0.7f}};
  return palette;
}

}  // namespace splotchcl::bench
