#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "device/scenes.h"
#include "projections/wide_frames.h"
#include "splotchcl/cube.h"
#include "splotchcl/stereo.h"

namespace splotchcl::test {

// Choices that are the same for every seed.
class RandomChoices {
 protected:
  explicit RandomChoices(std::uint64_t seed) : random_(seed) {}

  int integer(int low, int high) { return static_cast<int>(random_.uniform(low, high + 1)); }
  bool chance(double probability) { return random_.uniform() < probability; }
  Rgb color() {
    return {static_cast<float>(random_.uniform()), static_cast<float>(random_.uniform()),
            static_cast<float>(random_.uniform())};
  }
  // Of a picture, whose left and upper edges lie within these.
  Rectangle part_of(const Frame& frame, int right, int lower) {
    const int x = integer(0, right), y = integer(0, lower);
    return {x, y, integer(1, frame.width - x), integer(1, frame.height - y)};
  }
  // Up to so many clouds, in two colours.
  DrawnComponent component_around(int most, int kind, const std::function<Cloud()>& make_cloud,
                                  bool has_keys) {
    std::vector<Cloud> clouds;
    std::vector<float> colors, keys;
    for (int i = integer(1, most); i > 0; --i) {
      clouds.push_back(make_cloud());
      colors.push_back(static_cast<float>(random_.uniform()));
      if (has_keys) keys.push_back(static_cast<float>(integer(-5, 5)));
    }
    Palette palette;
    palette.emission = {color(), color()};
    if (kind == 3) palette.absorption = {color(), color()};
    DrawnComponent component = component_of(clouds, palette);
    component.particles.color = Column::owning(colors);
    if (has_keys) component.particles.sort_field = Column::owning(keys);
    if (kind == 1) component.absorption.kind = Absorption::Kind::none;
    if (kind == 2) component.absorption = {Absorption::Kind::gray, random_.logarithmic(0.1, 10)};
    if (kind == 4) component.absorption = {Absorption::Kind::factor, random_.logarithmic(0.3, 3)};
    return component;
  }

  Random random_;
};

// Random small scenes over all settings of the flat projections, the same for every seed.
class SceneMaker : RandomChoices {
 public:
  explicit SceneMaker(std::uint64_t seed) : RandomChoices(seed) {}

  Frame make() {
    Frame frame;
    frame.width = integer(1, 70);
    frame.height = integer(1, 60);
    frame.crop = chance(0.6) ? Rectangle{0, 0, frame.width, frame.height}
                             : part_of(frame, frame.width - 1, frame.height - 1);
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

  Vec3 center_{};
  double pixel_ = 1;
};

// Random small scenes in wide angles, for one eye or two, the same for every seed.
class WideSceneMaker : RandomChoices {
 public:
  explicit WideSceneMaker(std::uint64_t seed) : RandomChoices(seed) {}

  Frame make() {
    WideCamera camera;
    camera.projection = static_cast<Projection>(integer(2, 4));
    camera.width = integer(8, 70);
    camera.height = integer(8, 70);
    if (camera.projection == Projection::fisheye) camera.field_of_view = random_.uniform(60, 320);
    if (camera.projection == Projection::equirectangular) {
      if (chance(0.3)) camera.field_of_view = random_.uniform(40, 360);
      const double degrees = camera.field_of_view.value_or(360);
      camera.height = std::min(camera.height, static_cast<int>(camera.width * 180 / degrees));
    }
    if (camera.projection == Projection::cube) camera.height = camera.width;
    const int kind = integer(0, 3);
    Frame frame = wide_frame(camera, {});
    if (chance(0.3)) frame.kernel.cut = random_.uniform(1.5, 3);
    if (chance(0.2)) frame.kernel.min_radius_pixels = random_.uniform(0.1, 2);
    if (chance(0.4)) frame.background = {random_.uniform(), random_.uniform(), 0.0};
    if (chance(0.3)) frame.near_limit = random_.uniform(0.2, 0.6);
    frame.tolerance = chance(0.2) ? 1e-2 : 1e-3;
    frame.sort.descending = chance(0.3);
    choose_view(frame);
    for (int i = integer(1, 2); i > 0; --i)
      frame.components.push_back(component_around(
          200, kind, [this] { return cloud(); }, false));
    return frame;
  }

 private:
  void choose_view(Frame& frame) {
    if (chance(0.4)) {
      Stereo stereo;
      stereo.angle_degrees = random_.uniform(1, 10);
      if (chance(0.5)) stereo.mode = StereoMode::parallel;
      frame.camera = eye_camera(frame.camera, frame.projection, stereo, Eye::right);
    }
    if (frame.projection == Projection::cube) {
      frame.camera = cube_faces(frame.camera)[static_cast<std::size_t>(integer(0, 5))].camera;
    }
    if (chance(0.3)) frame.crop = part_of(frame, frame.width / 2, frame.height / 2);
  }

  // Directions all around, with more of them near the poles and the seam than there would be.
  Cloud cloud() {
    Vec3 direction = {{random_.uniform(-1, 1), random_.uniform(-1, 1), random_.uniform(-1, 1)}};
    if (chance(0.2)) direction.a[0] = direction.a[2] = random_.uniform(-0.05, 0.05);
    if (chance(0.2)) direction = {{random_.uniform(-0.1, 0.1), random_.uniform(-1, 1), -1}};
    return cloud_towards(direction, random_.uniform(0.3, 2), random_.logarithmic(5e-3, 0.5),
                         random_.logarithmic(0.01, 1));
  }
};

// Random small scenes with clouds around the camera, the same for every seed: all projections but
// the orthographic one, all plans, limits, orders and kernels.
class AroundSceneMaker : RandomChoices {
 public:
  explicit AroundSceneMaker(std::uint64_t seed, int largest_side = 60)
      : RandomChoices(seed), largest_side_(largest_side) {}

  Frame make() {
    WideCamera camera;
    constexpr Projection projections[] = {Projection::perspective, Projection::fisheye,
                                          Projection::equirectangular, Projection::cube};
    camera.projection = projections[integer(0, 3)];
    camera.width = integer(3, largest_side_);
    camera.height = integer(3, largest_side_);
    if (camera.projection == Projection::perspective)
      camera.field_of_view = random_.uniform(20, 110);
    if (camera.projection == Projection::fisheye) camera.field_of_view = random_.uniform(60, 320);
    if (camera.projection == Projection::equirectangular)
      camera.height = std::max(1, camera.width / 2);
    if (camera.projection == Projection::cube) camera.height = camera.width;
    Frame frame = wide_frame(camera, {});
    frame.through_clouds = true;
    constexpr double tolerances[] = {1e-2, 1e-3, 1e-3, 1e-4, 1e-5};
    frame.tolerance = tolerances[integer(0, 4)];
    if (chance(0.4)) frame.background = {random_.uniform(), random_.uniform(), 0.0};
    if (chance(0.2)) frame.near_limit = random_.uniform(0.1, 0.5);
    if (chance(0.2)) frame.far_limit = random_.uniform(1, 2);
    if (chance(0.2)) frame.kernel.min_radius_pixels = random_.uniform(0.1, 2);
    frame.sort.descending = chance(0.3);
    if (chance(0.3)) frame.sort.by = SortOrder::By::field;
    if (chance(0.3)) frame.crop = part_of(frame, frame.width - 1, frame.height - 1);
    if (chance(0.3) && is_wide_angle(camera.projection)) {
      frame.camera.eye_offset = random_.uniform(-0.05, 0.05);
      frame.camera.turn_axis = {{0, 1, 0}};
    }
    const int kind = integer(0, 4);
    for (int i = integer(1, 2); i > 0; --i)
      frame.components.push_back(component_around(
          60, kind, [this] { return cloud(); }, true));
    return frame;
  }

 private:
  // From within a cloud to three times as far as the last that is no splat alone; some of them lie
  // upon one another or at equal depths.
  Cloud cloud() {
    const Vec3 direction = {
        {random_.uniform(-1, 1), random_.uniform(-1, 1), random_.uniform(-1, 1)}};
    Cloud cloud = cloud_towards(direction, random_.uniform(0, 2), 1,
                                random_.logarithmic(0.01, chance(0.1) ? 20 : 1));
    cloud.sigma = random_.logarithmic(0.03, 1);
    if (chance(0.2)) cloud.z = 0.125 * integer(-4, 8);
    return cloud;
  }

  int largest_side_;
};

}  // namespace splotchcl::test
