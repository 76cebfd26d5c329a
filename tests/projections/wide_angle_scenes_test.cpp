// Random small scenes in wide angles, for one eye or two, keep their tolerance in both shapes
// of compositing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "device/pictures.h"
#include "projections/wide_frames.h"
#include "splotchcl/cube.h"
#include "splotchcl/stereo.h"

namespace splotchcl::test {
namespace {

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

// Light of discs that are cut so near a pixel's centre that it may be in or out, as in the
// tests of other random scenes; places here are known to 1e-3 pixels (poles magnify).
std::vector<double> light_on_edges(const Frame& frame) {
  std::vector<double> light(static_cast<std::size_t>(frame.crop.width) *
                            static_cast<std::size_t>(frame.crop.height));
  if (!frame.kernel.cut) return light;
  for (const reference::Splat& splat : reference::project(frame)) {
    const double radius = *frame.kernel.cut * splat.sigma;
    std::size_t i = 0;
    for (int y = frame.crop.y; y < frame.crop.y + frame.crop.height; ++y) {
      for (int x = frame.crop.x; x < frame.crop.x + frame.crop.width; ++x, ++i) {
        const double distance = std::hypot((x + 0.5 - splat.x) / splat.stretch, y + 0.5 - splat.y);
        if (std::abs(distance - radius) > 1e-3) continue;
        light[i] += splat.weight * std::exp(-*frame.kernel.cut * *frame.kernel.cut) *
                    *std::max_element(splat.emission, splat.emission + 3);
      }
    }
  }
  return light;
}

std::string describe(const Frame& frame) {
  std::ostringstream out;
  out << name(make_plan(frame).light) << ", projection " << static_cast<int>(frame.projection)
      << ", " << frame.width << " x " << frame.height << ", cut " << frame.kernel.cut.value_or(0)
      << ", eye " << frame.camera.eye_offset << ", tolerance " << frame.tolerance;
  return out.str();
}

double worst_error(const Frame& frame, const Image& image, const ExactImage& exact) {
  const std::vector<double> ambiguous = light_on_edges(frame);
  double worst = 0;
  for (std::size_t i = 0; i < exact.pixels.size(); ++i) {
    if (i % 4 == 3) continue;
    const double error = std::abs(static_cast<double>(image.pixels[i]) - exact.pixels[i]);
    const double beyond = (error - ambiguous[i / 4]) / std::max(1.0, std::abs(exact.pixels[i]));
    worst = std::max(worst, std::isfinite(beyond) ? beyond : 1e300);
  }
  return worst;
}

class WideAngleScenes : public PictureTest {};

TEST_F(WideAngleScenes, KeepTheirTolerance) {
  int lit = 0;
  for (std::uint64_t seed = 1; seed <= 90; ++seed) {
    const Frame frame = WideSceneMaker(seed).make();
    const ExactImage exact = reference::render(frame);
    lit += largest_value(exact) > 0.05;
    EXPECT_LE(worst_error(frame, draw(frame), exact), frame.tolerance)
        << "seed " << seed << ": " << describe(frame);
    if (seed % 3 != 0) continue;
    EXPECT_LE(worst_error(frame, draw(frame, CompositeShape::groups), exact), frame.tolerance)
        << "in groups, seed " << seed << ": " << describe(frame);
  }
  EXPECT_GT(lit, 60) << "most scenes should have something to see";
}

}  // namespace
}  // namespace splotchcl::test
