#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "publish/light_splats.h"
#include "splotchcl/finish.h"
#include "splotchcl/frame.h"

namespace splotchcl {

// A splat as viewers of 3D Gaussian splatting have it: a color, and one opacity with which it lies
// over what is behind it. Lengths are halves of the picture's width at the look-at point.
struct ViewerSplat {
  std::array<float, 3> place{};  // right, down and forward from the look-at point
  float deviation = 0;           // the standard deviation, > 0
  std::array<float, 3> color{};  // display values, 0 to 1
  float opacity = 0;             // in its middle, 0 to 1
};

// How light becomes opacity: 1 - exp(-(gain m)^exponent), with m the brightest channel over white.
// A lone splat has the display's brightness with the exponent 1 / gamma; where many overlap, light
// adds up with the exponent 1.
struct LightToOpacity {
  double gain = 1;
  double exponent = 1;
  double hue_at = 0.125;  // of white: dim splats have the hue that this much of their light shows
};

// What displays make of light: exposure, white, tone and what follows them, and gamma.
struct DisplayLight {
  FinishSettings finish;  // with exposure and white
  double gamma = 1;
};

// Display values, 0 to 1, of linear light.
Image displayed(Image light, const DisplayLight& display);

// In the order of the splats.
std::vector<ViewerSplat> viewer_splats(const std::vector<LightSplat>& splats, const Frame& frame,
                                       const DisplayLight& display, const LightToOpacity& opacity);

// What viewers show of the splats with the frame's camera, over black, in display values: splats
// are sorted by the depth of their middles, each is widened by 0.3 pixels squared and cut where it
// changes less than one of 255 steps or is three deviations away, and lies over those behind it.
Image picture_of_viewers(const std::vector<ViewerSplat>& splats, const Frame& frame);

// Splats for viewers, and how far what they show is from what the program shows.
struct NearestSplats {
  std::vector<ViewerSplat> splats;
  LightToOpacity opacity;
  double rms_difference = 0, largest_difference = 0;  // of display values, 0 to 1
};

// Those whose picture by viewers is nearest to `exact`, the frame's light over black, in display
// values and root mean square.
NearestSplats nearest_splats(const std::vector<LightSplat>& splats, const Frame& frame,
                             const Image& exact, const DisplayLight& display);

// Files of splats that viewers and other programs read. Each is whole in memory.
//   .ply   the layout of 3D Gaussian splatting: x right, y down, z forward
//   .glb   binary glTF 2.0 with KHR_gaussian_splatting, and the frame's camera: y is up
//   .usda  OpenUSD's ParticleField3DGaussianSplat (from 26.03 on): y is up
// The look-at point is the origin; half of the picture's width there is 1.
// `comment`, a line of ASCII, stands in the file.
std::string as_ply(const std::vector<ViewerSplat>& splats, const std::string& comment);
std::string as_glb(const std::vector<ViewerSplat>& splats, const Frame& frame,
                   const std::string& comment);
std::string as_usda(const std::vector<ViewerSplat>& splats, const std::string& comment);

// Whether a file's ending is one of these.
bool is_splat_file(const std::filesystem::path& path);

// As the path's ending says.
std::string as_splat_file(const std::filesystem::path& path, const std::vector<ViewerSplat>& splats,
                          const Frame& frame, const std::string& comment);

}  // namespace splotchcl
