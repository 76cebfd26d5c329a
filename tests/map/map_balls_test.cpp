#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "map/gas.h"

// Balls of gas of which maps are known in closed form.
namespace splotchcl {
namespace {

using test::at;
using test::Gas;
using test::map_of;
using test::map_scene;
using test::sigma_of_h;

const double pi = std::acos(-1.0);

// A lattice of spacing 1: sums of Gaussians wider than it are integrals, to many digits.
template <class Density>
Gas lattice(int reach, float h, Density density) {
  Gas gas;
  for (int x = -reach; x <= reach; ++x) {
    for (int y = -reach; y <= reach; ++y) {
      for (int z = -reach; z <= reach; ++z) {
        const double rho = density(std::sqrt(x * x + y * y + z * z));
        if (rho > 0) {
          gas.add({{double(x), double(y), double(z)}}, h, static_cast<float>(rho),
                  static_cast<float>(z * z), {{0, 0, 0}}, static_cast<float>(rho));
        }
      }
    }
  }
  return gas;
}

// rho = exp(-r^2 / s^2): smoothed with a kernel of sigma it is a Gaussian of s^2 + sigma^2.
TEST(MapOfABall, IsGaussianForAGaussianBall) {
  constexpr double s = 4;
  constexpr float h = 6;
  const Gas gas = lattice(18, h, [](double r) { return std::exp(-r * r / (s * s)); });
  const Map map = map_of(map_scene(), gas.snapshot());
  const double sigma = sigma_of_h * double{h}, wide = std::sqrt(s * s + sigma * sigma);
  const double mass = std::pow(pi, 1.5) * s * s * s;
  const auto along = [wide](double from) {
    return 0.5 * (std::erf((from + 1) / wide) - std::erf(from / wide));
  };
  for (const auto& [x, y] :
       {std::make_pair(32, 24), std::make_pair(35, 22), std::make_pair(26, 29)}) {
    const double expected = mass * along(x - 32) * along(23 - y);
    EXPECT_NEAR(static_cast<double>(at(map, x, y)) / expected, 1, 2e-6);
  }
}

// rho = 1 within R: the column at distance r is 2 sqrt(R^2 - r^2), and the mean of z^2 along it
// (R^2 - r^2) / 3. Smoothing lessens them by sigma^2 / (2 R^2) and sigma^2 / R^2 at the middle,
// which is 0.5 and 0.9 %, and by little more here. The lattice's edge is a cell wide.
TEST(MapOfABall, HasTheChordsOfAUniformBall) {
  constexpr double radius = 20;
  const Gas gas = lattice(21, 5, [](double r) { return std::clamp(radius + 0.5 - r, 0.0, 1.0); });
  Scene scene = map_scene();
  const Map column = map_of(scene, gas.snapshot());
  scene.map.quantity = "temperature";
  const Map mean = map_of(scene, gas.snapshot());
  for (const int x : {32, 38, 26}) {
    const double square = radius * radius - std::pow(x - 31.5, 2) - 0.25;
    EXPECT_NEAR(static_cast<double>(at(column, x, 24)) / (2 * std::sqrt(square)), 1, 0.01);
    EXPECT_NEAR(static_cast<double>(at(mean, x, 24)) / (square / 3), 1, 0.02);
  }
}

// In the plane through its center a uniform ball has its density, as far as the kernels reach.
TEST(MapOfABall, HasItsDensityInASlice) {
  const Gas gas = lattice(15, 5, [](double r) { return r <= 14 ? 1.0 : 0.0; });
  Scene scene = map_scene();
  scene.map.slice = true;
  EXPECT_NEAR(static_cast<double>(at(map_of(scene, gas.snapshot()), 32, 24)), 1, 1e-3);
}

}  // namespace
}  // namespace splotchcl
