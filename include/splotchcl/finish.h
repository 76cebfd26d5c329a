#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "splotchcl/vector.h"

// What is done to a picture after it has been drawn (docs/finish.md). In this order:
// bloom, exposure, white balance, tone, saturation, contrast, inset, colour bars, scale bar, texts,
// cross-fade, fade.
namespace splotchcl {

// Red, green, blue from 0 to 1 as the display shows them, whatever image.gamma is.
using DisplayColor = std::array<double, 3>;

// How light becomes what a display can show. With N a pixel's brightest channel and W the white
// point, both after exposure, all channels are multiplied by T(N) / N, so that hues hold.
//   linear  T = N / W
//   asinh   T = asinh(10 N) / asinh(10 W), at most 1 (Lupton et al. 2004, PASP 116, 133)
//   filmic  T = f(N) / f(W), at most 1, with a toe in the dark and a shoulder (src/finish/tone.h)
enum class ToneCurve { linear, asinh, filmic };

// Where in the picture something lies. Things at the same anchor stand below each other.
enum class Anchor { top_left, top, top_right, left, right, bottom_left, bottom, bottom_right };

// A line of text, or several with line breaks, with placeholders: "z = {redshift:.2f}".
struct TextSettings {
  std::string text;  // empty: none
  Anchor at = Anchor::top_left;
  std::optional<double> size;  // of the picture's shorter side; unset: FinishSettings::text_size,
                               // of titles 1.5 times that
};

// The palettes with their fields' values.
struct ColorBarSettings {
  bool show = false;
  Anchor at = Anchor::right;
  double length = 0.6;                  // of the picture's side along which the bars lie, 0.05 to 1
  std::vector<std::string> components;  // by name; empty: all that are coloured by a field
  std::vector<std::string> labels;      // one for each bar; empty: field and unit
};

// A length at the look-at point.
struct ScaleBarSettings {
  bool show = false;
  Anchor at = Anchor::bottom_left;
  std::optional<double> length;  // in the snapshot's unit, > 0; unset: a round one
  std::string unit;              // of the label; empty: the snapshot's
};

// The scene seen by a second camera, drawn into a corner. What is not set is the first's.
struct InsetSettings {
  bool show = false;
  Anchor at = Anchor::bottom_right;
  std::array<double, 2> size = {0.3, 0.3};  // of the picture's width and height
  double border = 0.002;                    // of the picture's shorter side
  DisplayColor border_color = {1, 1, 1};
  std::optional<Vec3> position, look_at, sky;
  std::optional<double> field_of_view_degrees;
  std::vector<std::string> components;  // by name; empty: all
};

// Another scene's picture, mixed into this one's.
struct CrossFade {
  std::string scene;  // a scene file; empty: none
  double amount = 0;  // from 0, only this scene, to 1, only the other
};

// All of it. Each default leaves the picture as it has been drawn.
struct FinishSettings {
  // The part of light that a lens scatters around where it falls, from 0 to 1
  // (src/finish/effects.h).
  double bloom = 0;
  // In stops: light is multiplied by 2^exposure. Unset: found from the picture, for a film once.
  std::optional<double> exposure = 0;
  bool exposure_follows = false;  // where it is unset, it changes slowly along a film
  ToneCurve tone = ToneCurve::linear;
  // Exposed light that becomes the display's white, > 0. Unset: found from the picture, as above.
  std::optional<double> white = 1;
  // From 0, bright light keeps its hue, to 1, it becomes white as it nears white. With T(N) as
  // above, each channel goes this part of T(N)^4 of its way to T(N).
  double highlights = 0;
  // In kelvin, 1667 to 25000: the light of a black body so hot becomes white. Unset: as drawn.
  std::optional<double> white_balance = std::nullopt;
  double saturation = 1;        // >= 0; 0: gray, by the luminance of Rec. 709, 1: as drawn
  double contrast = 1;          // >= 0: display value v becomes pivot (v / pivot)^contrast
  double contrast_pivot = 0.5;  // a display value, > 0

  std::string font = "DejaVuSans";  // a name, or a font file
  double text_size = 0.028;         // of the picture's shorter side
  DisplayColor text_color = {1, 1, 1};
  TextSettings title = {"", Anchor::top_left, std::nullopt};
  TextSettings label = {"", Anchor::top_right, std::nullopt};
  TextSettings caption = {"", Anchor::bottom_right, std::nullopt};
  std::optional<int> frame;  // what {frame} stands for

  ColorBarSettings color_bar;
  ScaleBarSettings scale_bar;
  InsetSettings inset;

  CrossFade cross_fade;
  double fade = 0;  // from 0, the picture, to 1, fade_color
  DisplayColor fade_color = {0, 0, 0};
};

}  // namespace splotchcl
