#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "reference/frames.h"
#include "splotchcl/camera.h"
#include "splotchcl/frame.h"
#include "splotchcl/reference.h"

// Frames of a camera at the origin that looks along +z, x to the right, y downwards.
namespace splotchcl::test {

struct WideCamera {
  Projection projection = Projection::fisheye;
  int width = 100, height = 100;
  std::optional<double> field_of_view = std::nullopt;
  double look_at_distance = 1;
};

inline Frame wide_frame(const WideCamera& wide, const std::vector<DrawnComponent>& components) {
  Camera camera;
  camera.look_at = {{0, 0, wide.look_at_distance}};
  camera.sky = {{0, -1, 0}};
  camera.projection = wide.projection;
  camera.field_of_view_degrees = wide.field_of_view;
  Frame frame = frame_of(wide.width, wide.height, components);
  frame.projection = wide.projection;
  frame.camera = make_camera_frame(camera, wide.width, wide.height);
  return frame;
}

// A cloud in this direction; sigma is its angular width.
inline Cloud cloud_towards(const Vec3& direction, double distance, double sigma,
                           double column = 1) {
  const double size = std::hypot(direction.a[0], direction.a[1], direction.a[2]);
  return {distance * direction.a[0] / size, distance * direction.a[1] / size,
          distance * direction.a[2] / size, distance * sigma, column};
}

inline DrawnComponent white_light(const std::vector<Cloud>& clouds) {
  DrawnComponent component = component_of(clouds, one_color(1, 1, 1));
  component.absorption.kind = Absorption::Kind::none;
  return component;
}

inline reference::Splat only_splat(const Frame& frame) {
  const std::vector<reference::Splat> splats = reference::project(frame);
  return splats.empty() ? reference::Splat{} : splats.front();
}

// Clouds all over the sphere, evenly (a Fibonacci spiral), whose light adds up to 1 in every
// direction: n clouds of solid angle pi sigma^2 and this column on 4 pi.
inline DrawnComponent even_sky(int count, double sigma) {
  std::vector<Cloud> clouds;
  const double golden_angle = pi * (3 - std::sqrt(5.0));
  const double column = 4 * pi / (count * pi * sigma * sigma);
  for (int i = 0; i < count; ++i) {
    const double y = 1 - (2 * i + 1.0) / count;
    const double radius = std::sqrt(1 - y * y);
    clouds.push_back(cloud_towards(
        {{radius * std::cos(golden_angle * i), y, radius * std::sin(golden_angle * i)}}, 2, sigma,
        column));
  }
  return white_light(clouds);
}

inline double red_of(const ReferenceImage& image, int x, int y) {
  return image.pixels[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                           static_cast<std::size_t>(x))];
}

}  // namespace splotchcl::test
