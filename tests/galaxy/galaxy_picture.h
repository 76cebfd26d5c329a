#pragma once

#include <array>
#include <cmath>

#include "generate/random.h"
#include "splotchcl/galaxy.h"
#include "splotchcl/image.h"

namespace splotchcl::test {

constexpr double sky_level = 0.02, sky_noise = 0.001;

// Linear light of an exponential disk around a pixel, on a noisy sky.
struct DiskPicture {
  int width = 160, height = 160;
  double center_x = 80, center_y = 80;
  double scale = 12;  // of the exponential, in pixels
  double peak = 0.8;
  double axis_ratio = 1;  // of the ellipses of equal light, longest upright
  std::array<double, 3> color = {1, 0.9, 0.7};

  Image draw() const {
    Random random(5);
    Image image(width, height);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const double radius = std::hypot((x + 0.5 - center_x) / axis_ratio, y + 0.5 - center_y);
        const double light = peak * std::exp(-radius / scale);
        for (std::size_t i = 0; i < 3; ++i) {
          image.at(x, y)[i] =
              static_cast<float>(light * color[i] + sky_level + sky_noise * random.normal());
        }
        image.at(x, y)[3] = 1;
      }
    }
    return image;
  }
};

// Two arms on the sky, with a dark lane along the inner side of each.
struct SpiralPicture {
  int side = 240;
  double scale = 30;  // pixels

  // From -pi to pi: how far a pixel lies from the middle of a lane, in the arms' phase.
  double phase(int x, int y) const {
    const double dx = x + 0.5 - side / 2.0, dy = side / 2.0 - y - 0.5;
    const double winds = std::log(std::hypot(dx, dy) / scale) / 0.36;
    return std::remainder(2 * (std::atan2(dy, dx) - winds), 2 * M_PI);
  }
  bool is_lane(int x, int y) const { return std::abs(phase(x, y)) < 0.25; }

  Image draw() const {
    constexpr std::array<double, 3> color = {1, 0.9, 0.75}, opacity = {0.6, 1, 1.3};
    Random random(6);
    Image image(side, side);
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const double radius = std::hypot(x + 0.5 - side / 2.0, y + 0.5 - side / 2.0);
        const double arm = 1 + 0.4 * std::cos(phase(x, y) - 0.8);
        const double lane = 0.8 * std::exp(-std::pow(phase(x, y) / 0.25, 2));
        for (std::size_t i = 0; i < 3; ++i) {
          const double light = 0.7 * color[i] * arm * std::exp(-radius / scale - lane * opacity[i]);
          image.at(x, y)[i] = static_cast<float>(light + sky_level + sky_noise * random.normal());
        }
        image.at(x, y)[3] = 1;
      }
    }
    return image;
  }
};

// Few particles, so that tests are fast.
inline GalaxySettings small_settings() {
  GalaxySettings settings;
  settings.size_kpc = 16;  // 0.1 kpc a pixel in a picture of 160
  settings.disk_stars = 20000;
  settings.bulge_stars = 5000;
  settings.clusters = 20;
  settings.cluster_stars = 100;
  return settings;
}

}  // namespace splotchcl::test
