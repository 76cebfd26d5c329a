#include "finish/white_balance.h"

#include <algorithm>
#include <array>
#include <boost/qvm/mat.hpp>
#include <boost/qvm/mat_operations.hpp>
#include <boost/qvm/vec_mat_operations.hpp>
#include <cstddef>

#include "splotchcl/vector.h"

namespace splotchcl {
namespace {

using ColorMatrix = boost::qvm::mat<double, 3, 3>;

// Rec. 709's primaries with D65 to CIE XYZ.
constexpr ColorMatrix rgb_to_xyz = {{{0.4123908, 0.3575843, 0.1804808},
                                     {0.2126390, 0.7151687, 0.0721923},
                                     {0.0193308, 0.1191948, 0.9505322}}};
// To the responses of cones, as Bradford's adaptation sharpens them.
constexpr ColorMatrix xyz_to_cones = {
    {{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};

// CIE XYZ with Y = 1 of a black body: cubics to the Planckian locus (B. Kim et al. 2002, Journal of
// the Korean Physical Society 41, 865).
Vec3 black_body(double kelvin) {
  const double t = 1000 / kelvin;
  const double x = kelvin < 4000 ? ((-0.2661239 * t - 0.2343589) * t + 0.8776956) * t + 0.179910
                                 : ((-3.0258469 * t + 2.1070379) * t + 0.2226347) * t + 0.240390;
  std::array<double, 4> cubic = {3.0817580, -5.87338670, 3.75112997, -0.37001483};
  if (kelvin < 2222) {
    cubic = {-1.1063814, -1.34811020, 2.18555832, -0.20219683};
  } else if (kelvin < 4000) {
    cubic = {-0.9549476, -1.37418593, 2.09137015, -0.16748867};
  }
  const double y = ((cubic[0] * x + cubic[1]) * x + cubic[2]) * x + cubic[3];
  return {{x / y, 1, (1 - x - y) / y}};
}

ColorMatrix adaptation(double kelvin) {
  using namespace boost::qvm;
  const Vec3 white = xyz_to_cones * (rgb_to_xyz * Vec3{{1, 1, 1}});
  const Vec3 body = xyz_to_cones * black_body(kelvin);
  ColorMatrix gains = {};
  for (std::size_t i = 0; i < 3; ++i)
    gains.a[i][i] = white.a[i] / body.a[i];
  const ColorMatrix to_cones = xyz_to_cones * rgb_to_xyz;
  return inverse(to_cones) * gains * to_cones;
}

}  // namespace

void balance_white(Image& image, double kelvin) {
  const ColorMatrix change = adaptation(kelvin);
  for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
    float* const pixel = &image.pixels[i];
    const Vec3 light = {{pixel[0], pixel[1], pixel[2]}};
    const Vec3 balanced = boost::qvm::operator*(change, light);
    for (std::size_t c = 0; c < 3; ++c)
      pixel[c] = static_cast<float>(std::max(0.0, balanced.a[c]));
  }
}

}  // namespace splotchcl
