#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "device/scenes.h"
#include "projections/wide_frames.h"
#include "splotchcl/cube.h"
#include "splotchcl/stereo.h"

namespace splotchcl::test {

// Random small scenes in wide angles, for one eye or two, the same for every seed.
class WideSceneMaker {
 public:
  explicit WideSceneMaker(std::uint64_t seed) : random_(seed) {}

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
      frame.components.push_back(make_component(kind));
    return frame;
  }

 private:
  int integer(int low, int high) { return static_cast<int>(random_.uniform(low, high + 1)); }
  bool chance(double probability) { return random_.uniform() < probability; }

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
    if (chance(0.3)) {
      frame.crop.x = integer(0, frame.width / 2);
      frame.crop.y = integer(0, frame.height / 2);
      frame.crop.width = integer(1, frame.width - frame.crop.x);
      frame.crop.height = integer(1, frame.height - frame.crop.y);
    }
  }

  Rgb color() {
    return {static_cast<float>(random_.uniform()), static_cast<float>(random_.uniform()),
            static_cast<float>(random_.uniform())};
  }

  // Directions all around, with more of them near the poles and the seam than there would be.
  Cloud cloud() {
    Vec3 direction = {{random_.uniform(-1, 1), random_.uniform(-1, 1), random_.uniform(-1, 1)}};
    if (chance(0.2)) direction.a[0] = direction.a[2] = random_.uniform(-0.05, 0.05);
    if (chance(0.2)) direction = {{random_.uniform(-0.1, 0.1), random_.uniform(-1, 1), -1}};
    return cloud_towards(direction, random_.uniform(0.3, 2), random_.logarithmic(5e-3, 0.5),
                         random_.logarithmic(0.01, 1));
  }

  DrawnComponent make_component(int kind) {
    std::vector<Cloud> clouds;
    std::vector<float> colors;
    for (int i = integer(1, 200); i > 0; --i) {
      clouds.push_back(cloud());
      colors.push_back(static_cast<float>(random_.uniform()));
    }
    Palette palette;
    palette.emission = {color(), color()};
    if (kind == 3) palette.absorption = {color(), color()};
    DrawnComponent component = component_of(clouds, palette);
    component.particles.color = Column::owning(colors);
    if (kind == 1) component.absorption.kind = Absorption::Kind::none;
    if (kind == 2) component.absorption = {Absorption::Kind::gray, random_.logarithmic(0.1, 10)};
    return component;
  }

  Random random_;
};

}  // namespace splotchcl::test
