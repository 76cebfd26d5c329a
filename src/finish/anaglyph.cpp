#include "finish/anaglyph.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace splotchcl {
namespace {

using LinearLight = std::array<double, 3>;
using Matrix = std::array<LinearLight, 3>;  // rows: red, green, blue

// What each eye's light adds to the picture.
struct Matrices {
  Matrix left, right;
};

// E. Dubois, A projection method to generate anaglyph stereo images, ICASSP 2001; the values for
// red and cyan filters and a cathode ray tube's phosphors.
constexpr Matrices dubois = {{{{0.4561, 0.500484, 0.176381},
                               {-0.0400822, -0.0378246, -0.0157589},
                               {-0.0152161, -0.0205971, -0.00546856}}},
                             {{{-0.0434706, -0.0879388, -0.00155529},
                               {0.378476, 0.73364, -0.0184503},
                               {-0.0721527, -0.112961, 1.2264}}}};

// Rec. 709's.
constexpr LinearLight luminance = {0.2126, 0.7152, 0.0722};
constexpr LinearLight nothing = {0, 0, 0};

const Matrices& matrices_of(StereoLayout layout) {
  static constexpr Matrices half_color = {{{luminance, nothing, nothing}},
                                          {{nothing, {0, 1, 0}, {0, 0, 1}}}};
  static constexpr Matrices gray = {{{luminance, nothing, nothing}},
                                    {{nothing, luminance, luminance}}};
  if (layout == StereoLayout::anaglyph_half_color) return half_color;
  return layout == StereoLayout::anaglyph_gray ? gray : dubois;
}

// Between a picture's light and what a display emits.
class Display {
 public:
  explicit Display(double gamma) : exponent_(2.2 / gamma) {}
  LinearLight emitted(const float* pixel) const {
    LinearLight light{};
    for (std::size_t c = 0; c < 3; ++c)
      light[c] = raised(std::clamp(static_cast<double>(pixel[c]), 0.0, 1.0), exponent_);
    return light;
  }
  float picture_light(double emitted) const {
    return static_cast<float>(raised(std::clamp(emitted, 0.0, 1.0), 1 / exponent_));
  }

 private:
  static double raised(double value, double exponent) {
    return exponent == 1 ? value : std::pow(value, exponent);
  }
  double exponent_;
};

double product(const LinearLight& row, const LinearLight& light) {
  return row[0] * light[0] + row[1] * light[1] + row[2] * light[2];
}

}  // namespace

Image anaglyph(const Image& left, const Image& right, StereoLayout layout, double gamma) {
  const Matrices& matrices = matrices_of(layout);
  const Display display(gamma);
  Image both(left.width, left.height);
  for (std::size_t i = 0; i < both.pixels.size(); i += 4) {
    const LinearLight of_left = display.emitted(&left.pixels[i]);
    const LinearLight of_right = display.emitted(&right.pixels[i]);
    for (std::size_t c = 0; c < 3; ++c) {
      const double sum = product(matrices.left[c], of_left) + product(matrices.right[c], of_right);
      both.pixels[i + c] = display.picture_light(sum);
    }
    both.pixels[i + 3] = 0.5F * (left.pixels[i + 3] + right.pixels[i + 3]);
  }
  return both;
}

}  // namespace splotchcl
