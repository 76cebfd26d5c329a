#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "device/scenes.h"

namespace splotchcl::test {

// Random small scenes over all settings of the flat projections, the same for every seed.
class SceneMaker {
 public:
  explicit SceneMaker(std::uint64_t seed) : random_(seed) {}

  Frame make() {
    Frame frame;
    frame.width = integer(1, 70);
    frame.height = integer(1, 60);
    frame.crop = random_crop(frame.width, frame.height);
    choose_camera(frame);
    choose_kernel(frame);
    constexpr double tolerances[] = {1e-2, 1e-3, 1e-3, 1e-4, 1e-5};
    frame.tolerance = tolerances[integer(0, 4)];
    if (chance(0.4)) frame.background = {random_.uniform(), random_.uniform(), 0.0};
    frame.sort.descending = chance(0.3);
    if (chance(0.3)) frame.sort.by = SortOrder::By::field;
    const int kind = integer(0, 3);
    const int component_count = integer(1, 3);
    for (int i = 0; i < component_count; ++i)
      frame.components.push_back(make_component(frame, kind));
    return frame;
  }

 private:
  int integer(int low, int high) { return static_cast<int>(random_.uniform(low, high + 1)); }
  bool chance(double probability) { return random_.uniform() < probability; }

  Rectangle random_crop(int width, int height) {
    if (chance(0.6)) return {0, 0, width, height};
    const int x = integer(0, width - 1), y = integer(0, height - 1);
    return {x, y, integer(1, width - x), integer(1, height - y)};
  }

  // Particles lie in a ball of radius 1 around the look-at point.
  void choose_camera(Frame& frame) {
    Camera camera;
    camera.look_at = {{random_.uniform(-5, 5), random_.uniform(-5, 5), random_.uniform(-5, 5)}};
    const double field_of_view = random_.uniform(1, 110);
    camera.field_of_view_degrees = field_of_view;
    const double distance = random_.uniform(0.3, 1.5) / std::tan(0.5 * field_of_view * pi / 180);
    camera.position = camera.look_at + Vec3{{0.48, -0.6, 0.64}} * distance;
    camera.sky = {{random_.uniform(-1, 1), 1, random_.uniform(-1, 1)}};
    if (chance(0.4)) camera.projection = Projection::orthographic;
    frame.camera = make_camera_frame(camera, frame.width, frame.height);
    frame.projection = camera.projection;
    if (chance(0.3)) frame.near_limit = distance - random_.uniform(0, 1);
    if (chance(0.3)) frame.far_limit = distance + random_.uniform(0, 1);
    center_ = camera.look_at;
    pixel_ = 1 / frame.camera.pixels_per_length;
  }

  void choose_kernel(Frame& frame) {
    if (chance(0.3)) {
      frame.kernel.cut = random_.uniform(1.5, 3);
      if (chance(0.5)) frame.kernel.sampling = Sampling::center;
    }
    if (chance(0.2)) frame.kernel.min_radius_pixels = random_.uniform(0.1, 2);
  }

  Palette random_palette(bool own_absorption) {
    Palette palette;
    const int knots = integer(1, 6);
    for (int i = 0; i < knots; ++i) {
      palette.emission.push_back(random_color());
      if (own_absorption) palette.absorption.push_back(random_color());
    }
    return palette;
  }
  Rgb random_color() {
    const auto channel = [this] {
      return chance(0.2) ? 0.0f : static_cast<float>(random_.uniform());
    };
    return {channel(), channel(), channel()};
  }

  ScalarMap random_map() {
    const int scaling = integer(0, 2);
    if (scaling == 0) return {Scaling::linear, -0.5, 2};
    if (scaling == 1) return {Scaling::log, -2, 0.5};
    return {Scaling::asinh, -1, 1};
  }

  DrawnComponent make_component(const Frame& frame, int kind) {
    DrawnComponent component;
    component.absorption = random_absorption(kind);
    component.palette = random_palette(kind == 3 && chance(0.5));
    component.brightness = chance(0.1) ? random_.logarithmic(3, 1e4) : random_.logarithmic(0.3, 3);
    component.size_factor = random_.uniform(0.5, 2);
    component.color = random_map();
    component.intensity = random_map();
    component.weight = static_cast<WeightModel>(integer(0, 2));
    component.reference_column = random_.logarithmic(0.1, 10);
    fill_particles(component, frame);
    return component;
  }

  Absorption random_absorption(int kind) {
    switch (kind) {
      case 0:
        return {Absorption::Kind::none, 0};
      case 1:
        return {Absorption::Kind::as_emission, 0};
      case 2:
        return {Absorption::Kind::factor, random_.logarithmic(0.1, 10)};
      default:
        return {static_cast<Absorption::Kind>(integer(0, 3)), random_.logarithmic(0.1, 10)};
    }
  }

  // Widths from a twentieth of a pixel to a third of the ball, and values that make columns
  // around 1 in every model of weights, with less from grains: what a grain on a pixel's
  // edge shows depends on its centre's last digits.
  void fill_particles(DrawnComponent& component, const Frame& frame) {
    const std::size_t count = static_cast<std::size_t>(integer(0, 300));
    Particles& particles = component.particles;
    particles.count = count;
    particles.origin = chance(0.5) ? center_ : Vec3{{0, 0, 0}};
    std::vector<float> positions, sizes, weights, colors, intensities, keys, vectors;
    const bool crowded = chance(0.15);
    const double smallest = 0.05 * pixel_ / frame.kernel.width / component.size_factor;
    double h = 1;
    for (std::size_t i = 0; i < count; ++i) {
      const bool again = crowded && i % 100 != 0;  // the place and width of the one before
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double place = center_.a[axis] + random_.uniform(-1, 1);
        positions.push_back(again ? positions[positions.size() - 3]
                                  : static_cast<float>(place - particles.origin.a[axis]));
        vectors.push_back(static_cast<float>(random_.uniform()));
      }
      if (!again) h = random_.logarithmic(smallest, std::max(1.0, 2 * smallest));
      const double sigma = frame.kernel.width * component.size_factor * h;
      const double column = component.reference_column * random_.logarithmic(0.01, 1.5);
      sizes.push_back(static_cast<float>(h));
      weights.push_back(static_cast<float>(component.weight == WeightModel::mass
                                               ? column * pi * sigma * sigma
                                               : column / (sigma * std::sqrt(pi))));
      colors.push_back(static_cast<float>(random_.uniform(-1, 3)));
      intensities.push_back(static_cast<float>(random_.uniform(-0.5, 3)));
      keys.push_back(static_cast<float>(integer(-20, 20)));
    }
    if (component.weight == WeightModel::constant) {
      // w = 1 / h: the narrowest has the largest.
      component.reference_column = 1 / smallest;
    }
    if (chance(0.3)) spoil(positions);
    if (chance(0.3)) spoil(weights);
    if (chance(0.3)) spoil(sizes);
    particles.position = Column::owning(positions);
    particles.smoothing_length = Column::owning(sizes);
    if (component.weight != WeightModel::constant) particles.weight = Column::owning(weights);
    if (chance(0.8)) particles.color = Column::owning(colors);
    if (chance(0.1)) particles.color_vector = Column::owning(vectors);
    if (chance(0.4)) particles.intensity = Column::owning(intensities);
    if (frame.sort.by == SortOrder::By::field) particles.sort_field = Column::owning(keys);
  }

  void spoil(std::vector<float>& values) {
    constexpr float bad[] = {std::numeric_limits<float>::quiet_NaN(),
                             std::numeric_limits<float>::infinity(),
                             -std::numeric_limits<float>::infinity()};
    for (std::size_t i = 3; i < values.size(); i += 41)
      values[i] = bad[i % 3];
  }

  Random random_;
  Vec3 center_{};
  double pixel_ = 1;
};

}  // namespace splotchcl::test
