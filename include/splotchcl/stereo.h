#pragma once

#include "splotchcl/camera.h"

namespace splotchcl {

// What the two eyes look at.
enum class StereoMode {
  off_axis,  // parallel view directions; what lies at the look-at distance has no disparity
  parallel,  // parallel view directions; what is infinitely far has no disparity
  toe_in,    // each eye looks at the look-at point
};

// Where the two eyes are, seen from the scene's camera.
enum class StereoEyes {
  right_shifted,  // the left eye is the camera, the right one a step to its right
  centered,       // each eye half a step to its side of the camera
};

// Two files; one picture of both, the left eye left or on top; the same of the size of one, each
// eye squeezed to half; or one picture in which each eye sees its own through a red glass (left)
// and a cyan one (right): anaglyphs.
//   anaglyph             by the least squares of Dubois (ICASSP 2001): colors as far as glasses let
//                        them through, and the least of the other eye's picture
//   anaglyph_half_color  red of the left eye's luminance, green and blue of the right eye
//   anaglyph_gray        red of the left eye's luminance, green and blue of the right eye's
enum class StereoLayout {
  files,
  side_by_side,
  top_bottom,
  side_by_side_half,
  top_bottom_half,
  anaglyph,
  anaglyph_half_color,
  anaglyph_gray
};

// Whether both eyes' pictures become one of the size of each.
inline bool is_anaglyph(StereoLayout layout) {
  return layout == StereoLayout::anaglyph || layout == StereoLayout::anaglyph_half_color ||
         layout == StereoLayout::anaglyph_gray;
}

// Whether each eye's picture is squeezed to half its width or height.
inline bool is_squeezed(StereoLayout layout) {
  return layout == StereoLayout::side_by_side_half || layout == StereoLayout::top_bottom_half;
}

// Two eyes that lie angle * |look_at - position| apart (the angle in radians).
struct Stereo {
  double angle_degrees = 0.2;  // above 0, at most 45: docs/projections.md says how much is fused
  StereoMode mode = StereoMode::off_axis;
  StereoEyes eyes = StereoEyes::right_shifted;
  StereoLayout layout = StereoLayout::files;
};

enum class Eye { left, right };

// Throws UsageError, naming the key, for an angle that is not in (0, 45] or a mode that the
// projection cannot have: parallel view directions show no depth in orthographic projection,
// and wide angles have no one point to turn the eyes to.
void check_stereo(const Stereo& stereo, Projection projection);

// The camera of one eye. Throws as check_stereo does.
CameraFrame eye_camera(const CameraFrame& camera, Projection projection, const Stereo& stereo,
                       Eye eye);

}  // namespace splotchcl
