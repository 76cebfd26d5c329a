#pragma once

#include "splotchcl/galaxy.h"
#include "splotchcl/renderer.h"

namespace splotchcl::test {

// One kind of a galaxy's matter in light that adds up.
inline DrawnComponent drawn_light(const GalaxyParticles& kind) {
  DrawnComponent component;
  component.particles.count = kind.count();
  component.particles.position = Column::owning(kind.position);
  component.particles.smoothing_length = Column::owning(kind.smoothing_length);
  component.particles.weight = Column::owning(kind.mass);
  component.particles.color_vector = Column::owning(kind.color);
  component.palette.emission = {{1, 1, 1}};
  component.absorption.kind = Absorption::Kind::none;
  return component;
}

inline DrawnComponent drawn_dust(const GalaxyParticles& dust) {
  DrawnComponent component = drawn_light(dust);
  component.brightness = 0;
  component.absorption = {Absorption::Kind::factor, 1};
  return component;
}

// A galaxy as a camera sees it.
inline Frame galaxy_frame(const Galaxy& galaxy, const Camera& camera, int width, int height) {
  Frame frame;
  frame.width = width;
  frame.height = height;
  frame.crop = {0, 0, width, height};
  frame.camera = make_camera_frame(camera, width, height);
  frame.projection = camera.projection;
  for (const GalaxyParticles* kind : {&galaxy.gas, &galaxy.disk, &galaxy.bulge, &galaxy.clusters})
    frame.components.push_back(drawn_light(*kind));
  frame.components.push_back(drawn_dust(galaxy.dust));
  return frame;
}

}  // namespace splotchcl::test
