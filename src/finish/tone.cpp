#include "finish/tone.h"

#include <algorithm>
#include <cmath>

namespace splotchcl {
namespace {

// Light from which on the asinh is more of a logarithm than a line.
constexpr double asinh_slope = 10;

// Hable's curve, with its value at 0 taken off exactly: x (x A (F - E) + B (C F - E)) over
// F (x (A x + B) + D F), which does not cancel for small x.
double film(double x) {
  constexpr double a = 0.22, b = 0.30, c = 0.10, d = 0.20, e = 0.01, f = 0.30;
  return x * (a * (f - e) * x + b * (c * f - e)) / (f * (x * (a * x + b) + d * f));
}

double curve_of(ToneCurve curve, double light) {
  switch (curve) {
    case ToneCurve::linear:
      break;
    case ToneCurve::asinh:
      return std::asinh(asinh_slope * light);
    case ToneCurve::filmic:
      return film(light);
  }
  return light;
}

}  // namespace

double tone(ToneCurve curve, double light, double white) {
  const double shown = curve_of(curve, light) / curve_of(curve, white);
  return curve == ToneCurve::linear ? shown : std::min(shown, 1.0);
}

void apply_tone(Image& image, ToneCurve curve, double white) {
  if (curve == ToneCurve::linear && white == 1) return;
  for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
    float* const pixel = &image.pixels[i];
    const double brightest = std::max({pixel[0], pixel[1], pixel[2]});
    if (!(brightest > 0) || !std::isfinite(brightest)) continue;
    const double factor = tone(curve, brightest, white) / brightest;
    for (int c = 0; c < 3; ++c)
      pixel[c] = static_cast<float>(factor * pixel[c]);
  }
}

}  // namespace splotchcl
