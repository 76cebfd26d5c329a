#pragma once

#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "device/scenes.h"
#include "reference/frames.h"
#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

// Building blocks of hard frames.
namespace splotchcl::test {

// The absorption that makes a frame of any components need this plan.
inline Frame lit(Frame frame, LightPlan plan) {
  for (DrawnComponent& component : frame.components) {
    if (plan == LightPlan::emission) component.absorption = {Absorption::Kind::none, 0};
    if (plan == LightPlan::proportional) component.absorption = {Absorption::Kind::as_emission, 0};
    if (plan == LightPlan::ordered) component.absorption = {Absorption::Kind::gray, 0.2};
  }
  return frame;
}

// Both components absorb `factor` of what their palettes emit at brightness 1: the same
// light as one component with that factor, but the plan cannot know and must order it.
inline Frame ordered_by_two_components(Frame frame) {
  DrawnComponent nothing = frame.components.front();
  nothing.particles = component_of({}, nothing.palette).particles;
  nothing.brightness *= 2;  // another source
  frame.components.push_back(nothing);
  return frame;
}

// A frame seen by a camera that is made as scenes make it.
inline Frame seen_by(const Camera& camera, int width, int height,
                     const std::vector<DrawnComponent>& components) {
  Frame frame = frame_of(width, height, components);
  frame.camera = make_camera_frame(camera, width, height);
  frame.projection = camera.projection;
  frame.near_limit = camera.near_limit;
  frame.far_limit = camera.far_limit;
  return frame;
}

// Random palette positions, one per particle.
inline DrawnComponent in_random_colors(DrawnComponent component, std::uint64_t seed = 5) {
  Random random(seed);
  std::vector<float> colors;
  for (std::size_t i = 0; i < component.particles.count; ++i)
    colors.push_back(static_cast<float>(random.uniform()));
  component.particles.color = Column::owning(colors);
  return component;
}

// Every pixel of the frame's crop has this light, and an opacity that is not given.
inline ReferenceImage even_picture(const Frame& frame, double red, double green, double blue) {
  ReferenceImage image(frame.crop.width, frame.crop.height);
  for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
    image.pixels[i] = red;
    image.pixels[i + 1] = green;
    image.pixels[i + 2] = blue;
    image.pixels[i + 3] = std::numeric_limits<double>::quiet_NaN();
  }
  return image;
}

}  // namespace splotchcl::test
