#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "device/scenes.h"
#include "projections/wide_frames.h"

namespace splotchcl::test {

// Random small scenes with clouds around the camera, the same for every seed: all projections but
// the orthographic one, all plans, limits, orders and kernels.
class AroundSceneMaker {
 public:
  explicit AroundSceneMaker(std::uint64_t seed, int largest_side = 60)
      : random_(seed), largest_side_(largest_side) {}

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
    if (chance(0.3)) choose_crop(frame);
    if (chance(0.3) && is_wide_angle(camera.projection)) {
      frame.camera.eye_offset = random_.uniform(-0.05, 0.05);
      frame.camera.turn_axis = {{0, 1, 0}};
    }
    const int kind = integer(0, 4);
    for (int i = integer(1, 2); i > 0; --i)
      frame.components.push_back(make_component(kind));
    return frame;
  }

 private:
  int integer(int low, int high) { return static_cast<int>(random_.uniform(low, high + 1)); }
  bool chance(double probability) { return random_.uniform() < probability; }

  void choose_crop(Frame& frame) {
    frame.crop.x = integer(0, frame.width - 1);
    frame.crop.y = integer(0, frame.height - 1);
    frame.crop.width = integer(1, frame.width - frame.crop.x);
    frame.crop.height = integer(1, frame.height - frame.crop.y);
  }

  Rgb color() {
    return {static_cast<float>(random_.uniform()), static_cast<float>(random_.uniform()),
            static_cast<float>(random_.uniform())};
  }

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

  DrawnComponent make_component(int kind) {
    std::vector<Cloud> clouds;
    std::vector<float> colors, keys;
    for (int i = integer(1, 60); i > 0; --i) {
      clouds.push_back(cloud());
      colors.push_back(static_cast<float>(random_.uniform()));
      keys.push_back(static_cast<float>(integer(-5, 5)));
    }
    Palette palette;
    palette.emission = {color(), color()};
    if (kind == 3) palette.absorption = {color(), color()};
    DrawnComponent component = component_of(clouds, palette);
    component.particles.color = Column::owning(colors);
    component.particles.sort_field = Column::owning(keys);
    if (kind == 1) component.absorption.kind = Absorption::Kind::none;
    if (kind == 2) component.absorption = {Absorption::Kind::gray, random_.logarithmic(0.1, 10)};
    if (kind == 4) component.absorption = {Absorption::Kind::factor, random_.logarithmic(0.3, 3)};
    return component;
  }

  Random random_;
  int largest_side_;
};

}  // namespace splotchcl::test
