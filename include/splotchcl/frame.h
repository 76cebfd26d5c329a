#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "splotchcl/camera.h"
#include "splotchcl/image.h"
#include "splotchcl/light_model.h"
#include "splotchcl/palette.h"
#include "splotchcl/particles.h"

namespace splotchcl {

class SpreadParticles;

// A field's way to [0, 1], with every number decided: scaled(v) is v, log10(v) or
// asinh(v); normalised = clamp((scaled(v) - minimum) / (maximum - minimum), 0, 1).
// minimum and maximum are after scaling. maximum == minimum maps all to 0.
// A value whose scaled form is not finite maps to 0.
struct ScalarMap {
  Scaling scaling = Scaling::linear;
  double minimum = 0;
  double maximum = 1;
};

// A component with its particles and every number decided.
struct DrawnComponent {
  std::string name;  // for messages
  Particles particles;
  double size_factor = 1;  // h_drawn = size_factor * smoothing_length, > 0
  ScalarMap color;         // from particles.color to the palette
  ScalarMap intensity;     // from particles.intensity to the factor I
  WeightModel weight = WeightModel::mass;
  double reference_column = 1;  // w is divided by it; > 0, in w's unit
  // How many particles of the snapshot each stands for where only a part of them is read; the
  // reference column is smaller by as much already.
  double particles_per_drawn = 1;
  Palette palette;
  double brightness = 1;  // >= 0, a factor on the palette's emission
  Absorption absorption;
};

// A part of the picture, in pixels of the whole picture.
struct Rectangle {
  int x = 0, y = 0, width = 0, height = 0;
};

// Everything a renderer needs for one picture, the same for the device and the reference.
// Renderer::render throws UsageError for a crop or a background image that does not fit the
// picture; the reference takes what it gets.
struct Frame {
  int width = 0, height = 0;  // of the whole picture, in pixels: they fix the camera
  Rectangle crop;             // what is drawn; inside the picture, not empty
  CameraFrame camera;
  Projection projection = Projection::perspective;
  std::optional<double> near_limit, far_limit;   // as Camera has them, in lengths
  bool through_clouds = false;                   // as Camera has it
  DepthFade fade;                                // likewise
  Lens lens;                                     // of perspective cameras
  std::array<double, 3> background = {0, 0, 0};  // linear light behind everything, >= 0
  // Light behind everything, pixel by pixel, instead of `background`: width x height
  // pixels, linear, finite and >= 0. Null: there is none.
  std::shared_ptr<const Image> background_image;
  KernelSettings kernel;
  SortOrder sort;
  // What the device promises of every pixel and channel: |picture - reference| <=
  // tolerance * max(1, |reference|), >= 0; 0: the most exact that it can do (docs/accuracy.md).
  double tolerance = 1e-3;
  std::vector<DrawnComponent> components;
  // Where particles are spread over ranks (spread_snapshot.h), what the renderer gets those from
  // that it draws. Null: this process has them all.
  std::shared_ptr<SpreadParticles> spread;
};

// Of all components together, bad ones included.
inline std::uint64_t particle_count(const Frame& frame) {
  std::uint64_t count = 0;
  for (const DrawnComponent& component : frame.components)
    count += component.particles.count;
  return count;
}

}  // namespace splotchcl
