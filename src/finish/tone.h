#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "splotchcl/finish.h"
#include "splotchcl/image.h"

namespace splotchcl {

// Linear light of Rec. 709 in which that of a black body at so many kelvin, 1667 to 25000, becomes
// white (D65), by Bradford's adaptation; what falls below 0 is 0. Alpha stays.
void balance_white(Image& image, double kelvin);

// What the display shows of exposed light >= 0 of a pixel's brightest channel, where `white` > 0
// becomes 1. Each curve goes from 0 at 0 and never falls; asinh and filmic end at 1.
//   linear  light / white
//   asinh   asinh(10 light) / asinh(10 white): straight where it is dark, a logarithm where it is
//           bright (Lupton et al. 2004, PASP 116, 133)
//   filmic  f(light) / f(white) with John Hable's curve (Filmic Tonemapping Operators, 2010)
//           f(x) = (x (A x + C B) + D E) / (x (A x + B) + D F) - E / F
//           A = 0.22, B = 0.30, C = 0.10, D = 0.20, E = 0.01, F = 0.30
double tone(ToneCurve curve, double light, double white);

// The most by which shown light rises for each unit that exposed light does, up to `white`.
double steepest_slope(ToneCurve curve, double white);

// The curve for each pixel: red, green and blue times tone(N) / N, N the largest of them. This is a
// curve of luminance that starts, for each hue, at 0 and ends at the brightest that a display can
// show in that hue; Rec. 709's luminance itself would push pure colors that are within the
// display's reach out of it. Alpha stays, and so does light that is not finite.
//
// `highlights` takes bright light towards white, where film and eyes end, and no single hue: a
// channel L T / N becomes L T / N + h (T - L T / N) with h = highlights T^4, T at most 1. Like
// Khronos' PBR Neutral (2024), which this follows, it mixes the compressed color with white as its
// largest channel nears white, so that gray stays gray and no channel ever falls as light rises;
// the weight is simpler, and begins in the dark.
void apply_tone(Image& image, ToneCurve curve, double white, double highlights = 0);

// How many pixels have how much light in their brightest channel. Bins are a 256th of an octave
// wide at most, so that what follows does not hang on a picture's last digits.
class LightHistogram {
 public:
  LightHistogram();
  void add(const Image& image);

  // The upper edge of the bin that has the brightest light but one part of what is at least
  // `lowest`; 0 where nothing is.
  double exceeded_by(double part, double lowest) const;
  // Of all pixels, how many have at least `lowest`.
  double part_from(double lowest) const;
  // The lower edge of the darkest bin of the brightest pixels, a part of all; 0 where these take
  // in dark ones.
  double reached_by(double part) const;

 private:
  std::vector<std::uint64_t> counts_;  // [bin], rising light; the first: none
  std::uint64_t pixels_ = 0;
};

// Puts exposure and white of `found` where `finish` leaves them open.
void take_tone(const FinishSettings& found, FinishSettings& finish);

// Whether exposure or white is left to the picture.
bool has_open_tone(const FinishSettings& finish);

// The settings with exposure and white found from light as it has been drawn:
//   - what 0.3 % of the pixels exceed that matter fills is 98 % of white, or less, where a tenth of
//     them would exceed half of it, so that what is even and bright is not white; matter fills the
//     pixels with at least a thousandth of that,
//   - exposure is the least, in twentieths of a stop, that lifts a quarter of all pixels, or as
//     much as matter fills, to 4 % of white after contrast, and not below what makes white 1. Where
//     white is given, or the curve is a line, it is what takes that light to white.
// Nothing for a picture without light, or with less than 1e-9 of white. The settings themselves
// where nothing is open.
std::optional<FinishSettings> with_tone_of(const FinishSettings& finish, double gamma,
                                           const LightHistogram& light);

// As above; exposure 0 and white 1 where the picture is black.
FinishSettings with_any_tone(const FinishSettings& finish, double gamma,
                             const LightHistogram& light);

// Exposure, then white balance, tone, saturation and contrast, of linear light; alpha stays.
// Nothing happens to pixels for settings that change nothing. Exposure and white are known (above).
//   exposure     L' = L 2^exposure
//   balance      as balance_white() has it
//   tone         as tone() has it
//   saturation   L' = max(0, Y + saturation (L - Y)), Y = 0.2126 R + 0.7152 G + 0.0722 B
//   contrast     L' = p (L / p)^contrast with p = contrast_pivot^gamma, which is
//                v' = pivot (v / pivot)^contrast of display values v = L^(1/gamma)
void adjust_light(Image& image, const FinishSettings& finish, double gamma);

// The light whose display value v is given: v^gamma.
std::array<float, 3> light_of(const DisplayColor& color, double gamma);

}  // namespace splotchcl
