#pragma once

#include <cmath>
#include <vector>

#include "scene/constants.h"
#include "splotchcl/frame.h"

// Small frames whose pictures can be worked out on paper: an orthographic camera at the
// origin looks along +z with one pixel per length unit, so that a particle at (x, y, z)
// falls on pixel coordinates (x + width / 2, y + height / 2) and sigma is in pixels.
namespace splotchcl::test {

struct Cloud {
  double x = 0, y = 0, z = 1;
  double sigma = 1;
  double column = 1;  // w, through the centre
};

inline Frame empty_frame(int width, int height) {
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
  return frame;
}

inline Palette one_color(float red, float green, float blue) {
  Palette palette;
  palette.emission = {Rgb{red, green, blue}};
  return palette;
}

// kernel.width is set to 1 by the frames of these tests, so h is sigma.
inline DrawnComponent component_of(const std::vector<Cloud>& clouds, const Palette& palette) {
  DrawnComponent component;
  std::vector<float> position, h, mass;
  for (const Cloud& cloud : clouds) {
    position.push_back(static_cast<float>(cloud.x));
    position.push_back(static_cast<float>(cloud.y));
    position.push_back(static_cast<float>(cloud.z));
    h.push_back(static_cast<float>(cloud.sigma));
    mass.push_back(static_cast<float>(cloud.column * pi * cloud.sigma * cloud.sigma));
  }
  component.particles.count = clouds.size();
  component.particles.position = Column::owning(position);
  component.particles.smoothing_length = Column::owning(h);
  component.particles.weight = Column::owning(mass);
  component.palette = palette;
  return component;
}

inline Frame frame_of(int width, int height, const std::vector<DrawnComponent>& components) {
  Frame frame = empty_frame(width, height);
  frame.kernel.width = 1;
  frame.components = components;
  return frame;
}

}  // namespace splotchcl::test
