#include "galaxy/sky.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "galaxy/light.h"

namespace splotchcl {
namespace {

constexpr double border_fraction = 0.02;                   // of the shorter side
constexpr double deviations_per_median_distance = 1.4826;  // of a Gaussian

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::vector<Light> border_pixels(const Image& picture) {
  const int shorter = std::min(picture.width, picture.height);
  const int width = std::max(1, static_cast<int>(std::lround(border_fraction * shorter)));
  std::vector<Light> pixels;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const int distance = std::min({x, y, picture.width - 1 - x, picture.height - 1 - y});
      if (distance < width) pixels.push_back(light_at(picture, x, y));
    }
  }
  return pixels;
}

}  // namespace

Sky measure_sky(const Image& picture) {
  const std::vector<Light> border = border_pixels(picture);
  Sky sky;
  std::vector<double> values(border.size());
  const auto median_of = [&](auto&& value) {
    std::transform(border.begin(), border.end(), values.begin(), value);
    return median(values);
  };
  for (std::size_t i = 0; i < 3; ++i)
    sky.level[i] = median_of([i](const Light& light) { return light[i]; });
  const double middle = median_of([](const Light& light) { return mean(light); });
  sky.noise = deviations_per_median_distance *
              median_of([middle](const Light& light) { return std::abs(mean(light) - middle); });
  return sky;
}

Image without_sky(const Image& picture, const Sky& sky) {
  Image result = picture;
  for (std::size_t i = 0; i < result.pixels.size(); ++i) {
    if (i % 4 == 3) continue;
    const double above = static_cast<double>(picture.pixels[i]) - sky.level[i % 4];
    result.pixels[i] = static_cast<float>(std::max(0.0, above));
  }
  return result;
}

namespace {

constexpr int ring_radius = 5;  // pixels: wider than a star is
constexpr int halo = 1;         // pixels around a star's that hold its light too
constexpr double line_emission_excess = 1.15;

// Visits the pixels of the square ring around a pixel that lie in the picture.
template <typename Visit>
void for_ring(const Image& picture, int x, int y, Visit&& visit) {
  for (int dy = -ring_radius; dy <= ring_radius; ++dy) {
    const bool is_edge = std::abs(dy) == ring_radius;
    for (int dx = -ring_radius; dx <= ring_radius; dx += is_edge ? 1 : 2 * ring_radius) {
      const int at_x = x + dx, at_y = y + dy;
      if (at_x < 0 || at_y < 0 || at_x >= picture.width || at_y >= picture.height) continue;
      visit(at_x, at_y);
    }
  }
}

double take_median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

bool shines_in_lines(const Light& light) {
  return light[0] > line_emission_excess * light[1] && light[2] > light[1];
}

class StarMask {
 public:
  explicit StarMask(const Image& picture)
      : width_(picture.width), height_(picture.height), marked_(picture.pixels.size() / 4) {}

  void mark(int x, int y) {
    for (int dy = -halo; dy <= halo; ++dy) {
      for (int dx = -halo; dx <= halo; ++dx) {
        if (x + dx < 0 || y + dy < 0 || x + dx >= width_ || y + dy >= height_) continue;
        marked_[index(x + dx, y + dy)] = 1;
      }
    }
  }
  bool at(int x, int y) const { return marked_[index(x, y)] != 0; }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }
  int width_, height_;
  std::vector<char> marked_;
};

StarMask find_stars(const Image& picture, const StarCriteria& criteria) {
  StarMask stars(picture);
  std::vector<double> ring;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const Light light = light_at(picture, x, y);
      const double brightness = mean(light);
      if (brightness <= criteria.least_light || shines_in_lines(light)) continue;
      const double distance = std::hypot(x - criteria.center_x, y - criteria.center_y);
      if (distance < criteria.protected_radius) continue;
      ring.clear();
      for_ring(picture, x, y,
               [&](int rx, int ry) { ring.push_back(mean(light_at(picture, rx, ry))); });
      if (ring.empty()) continue;
      if (brightness > criteria.contrast * take_median(ring) + criteria.least_light) {
        stars.mark(x, y);
      }
    }
  }
  return stars;
}

}  // namespace

std::uint64_t remove_foreground_stars(Image& picture, const StarCriteria& criteria) {
  const Image original = picture;
  const StarMask stars = find_stars(original, criteria);
  std::uint64_t replaced = 0;
  std::vector<double> ring;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      if (!stars.at(x, y)) continue;
      ++replaced;
      for (std::size_t channel = 0; channel < 3; ++channel) {
        ring.clear();
        for_ring(original, x, y, [&](int rx, int ry) {
          if (!stars.at(rx, ry)) ring.push_back(light_at(original, rx, ry)[channel]);
        });
        picture.at(x, y)[channel] = ring.empty() ? 0.0F : static_cast<float>(take_median(ring));
      }
    }
  }
  return replaced;
}

}  // namespace splotchcl
