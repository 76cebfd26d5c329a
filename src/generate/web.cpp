#include "generate/web.h"

#include <cmath>
#include <complex>

#include "generate/gather.h"
#include "generate/profile.h"
#include "parallel/for_blocks.h"
#include "scene/constants.h"

namespace splotchcl {
namespace {

constexpr int longest_wave = 24;
constexpr int grid_side = 96;
constexpr std::size_t places_at_once = 4096;
constexpr double web_wave = 6.5;    // waves per box; shorter ones do not move the web
constexpr double strand_wave = 13;  // shorter ones do not make strands
constexpr double straying = 0.45;   // part of linear theory's displacement

// Bent where radiation ruled: Bardeen et al. (1986), by waves per box.
double power(double wave, double box_size) {
  constexpr double shape = 0.2;
  const double q = 2 * pi * wave / (box_size / 1000) / shape;
  const double polynomial =
      1 + 3.89 * q + std::pow(16.1 * q, 2) + std::pow(5.46 * q, 3) + std::pow(6.71 * q, 4);
  const double transfer = std::log1p(2.34 * q) / (2.34 * q) / std::pow(polynomial, 0.25);
  return wave * transfer * transfer;
}

// The mean of a wave over a ball.
double ball(double wave, double radius) {
  const double x = 2 * pi * wave * radius;
  return x < 1e-3 ? 1 : 3 * (std::sin(x) - x * std::cos(x)) / (x * x * x);
}

}  // namespace

Web::Web(double box_size, Random& random)
    : waves_(
          longest_wave, [box_size](double wave) { return power(wave, box_size); }, random),
      amplitude_(cosmology::sigma_8 / std::sqrt(waves_.variance([box_size](double wave) {
                   return ball(wave, 8000 / box_size);
                 }))),
      displacement_{displacement(0, 0, web_wave), displacement(1, 0, web_wave),
                    displacement(2, 0, web_wave)},
      straying_{displacement(0, web_wave, strand_wave), displacement(1, web_wave, strand_wave),
                displacement(2, web_wave, strand_wave)} {}

Vec3 Web::displaced(const Vec3& birthplace) const {
  Vec3 place = birthplace;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    place.a[axis] += displacement_[axis].interpolate(birthplace);
  }
  return place;
}

Vec3 Web::strayed(const Vec3& birthplace) const {
  Vec3 by;
  for (std::size_t axis = 0; axis < 3; ++axis)
    by.a[axis] = straying * straying_[axis].interpolate(birthplace);
  return by;
}

std::vector<double> Web::sharpness(const std::vector<Vec3>& birthplaces) const {
  constexpr double radius = 0.025, least = 0.3, none = -1, all = 1.5;
  const PeriodicGrid grid = contrast(radius);
  std::vector<double> parts(birthplaces.size());
  for_blocks(parts.size(), places_at_once, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const double collapsed = smoothstep((grid.interpolate(birthplaces[i]) - none) / (all - none));
      parts[i] = least + (1 - least) * collapsed;
    }
  });
  return parts;
}

PeriodicGrid Web::contrast(double radius) const {
  return waves_.evaluate(grid_side, [&](WaveNumber n) {
    return std::complex<double>(amplitude_ * ball(n.length(), radius));
  });
}

// Its divergence is minus the contrast. Short waves, which have collapsed long ago, would
// only blur the web.
PeriodicGrid Web::displacement(int axis, double shortest, double longest) const {
  const auto low_pass = [](double length, double limit) {
    return limit > 0 ? std::exp(-0.5 * std::pow(length / limit, 2)) : 0;
  };
  return waves_.evaluate(grid_side, [&](WaveNumber n) {
    const int component[3] = {n.x, n.y, n.z};
    const double length = n.length();
    const double kept = low_pass(length, longest) - low_pass(length, shortest);
    return std::complex<double>(0,
                                amplitude_ * kept * component[axis] / (2 * pi * length * length));
  });
}

void sharpen_web(std::vector<Vec3>& places, const std::vector<double>& parts,
                 std::vector<Halo>& haloes) {
  constexpr int side = 128;
  constexpr double widths[] = {1.6, 1.3, 1};  // in cells
  for (const double width : widths) {
    const PeriodicGrid density = smoothed_density(places, side, width);
    for_blocks(places.size(), places_at_once, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i)
        places[i] += step_uphill(density, places[i], width) * parts[i];
    });
    for (Halo& halo : haloes)
      halo.center += step_uphill(density, halo.center, width);
  }
}

}  // namespace splotchcl
