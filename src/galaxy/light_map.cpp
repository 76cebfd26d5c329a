#include "galaxy/light_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "galaxy/light.h"
#include "splotchcl/error.h"
#include "splotchcl/image.h"

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

namespace {

using PixelPlace = std::array<double, 2>;

// The centroid of what lies within a radius; the point itself where that is dark.
PixelPlace centroid(const Image& picture, const PixelPlace& point, double radius) {
  double sum = 0;
  PixelPlace weighted = {0, 0};
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const double px = x + 0.5, py = y + 0.5;
      if (std::hypot(px - point[0], py - point[1]) > radius) continue;
      const double light = mean(light_at(picture, x, y));
      sum += light;
      weighted[0] += light * px;
      weighted[1] += light * py;
    }
  }
  if (!(sum > 0)) return point;
  return {weighted[0] / sum, weighted[1] / sum};
}

bool has_light(const Image& picture) {
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    if (i % 4 != 3 && picture.pixels[i] > 0) return true;
  }
  return false;
}

// The centre of light in pixels from the left and top of a picture without sky: the centroid
// within circles that shrink around it, so that companions, arms and what lies far out count
// less and less. Throws DataError for a picture without light.
std::array<double, 2> find_center(const Image& picture) {
  if (!has_light(picture)) {
    throw DataError("the picture has no light above its sky, expected a galaxy");
  }
  constexpr double shrink = 0.8;
  constexpr double last_fraction = 0.02;  // of the shorter side: a nucleus
  const double shorter = std::min(picture.width, picture.height);
  PixelPlace point = {picture.width / 2.0, picture.height / 2.0};
  point = centroid(picture, point, std::hypot(picture.width, picture.height));
  for (double radius = shorter / 2; radius > std::max(2.0, last_fraction * shorter);
       radius *= shrink) {
    // Twice: the circle follows what it found.
    point = centroid(picture, point, radius);
    point = centroid(picture, point, radius);
  }
  return point;
}

constexpr double nucleus_fraction = 0.04;  // of the shorter side, kept from star removal
constexpr double rim_fraction = 0.1;       // of the radius, over which the disk ends

constexpr double lane_fraction = 0.05;   // of the radius: what is wider than a lane
constexpr double half_fraction = 0.5;    // of the radius, within which most light is
constexpr double faint_fraction = 0.03;  // of its mean light: tells of no dust

double smooth_step(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

DiskPlane::Point choose_center(const Image& picture, const GalaxySettings& settings,
                               double file_pixels) {
  if (!settings.center) return find_center(picture);
  const DiskPlane::Point center = {(*settings.center)[0] / file_pixels,
                                   (*settings.center)[1] / file_pixels};
  const bool inside =
      center[0] >= 0 && center[1] >= 0 && center[0] <= picture.width && center[1] <= picture.height;
  if (!inside) {
    throw UsageError("the centre " + std::to_string((*settings.center)[0]) + "," +
                     std::to_string((*settings.center)[1]) +
                     " lies outside the picture; give pixels from its left and top");
  }
  return center;
}

// To the farthest corner, as it lies in the disk.
double whole_radius(const Image& picture, const DiskPlane& plane) {
  double radius = 0;
  for (const double x : {0.0, static_cast<double>(picture.width)}) {
    for (const double y : {0.0, static_cast<double>(picture.height)}) {
      const DiskPlane::Point corner = plane.in_disk({x, y});
      radius = std::max(radius, std::hypot(corner[0], corner[1]));
    }
  }
  return radius;
}

}  // namespace

LightMap::LightMap(const Image& picture, const GalaxySettings& settings, double file_pixels)
    : sky_(measure_sky(picture)),
      picture_(without_sky(picture, sky_)),
      center_(choose_center(picture_, settings, file_pixels)),
      plane_(center_, settings.inclination_degrees, settings.position_angle_degrees,
             settings.size_kpc / std::max(picture.width, picture.height)) {
  threshold_ = settings.threshold * sky_.noise;
  if (settings.removes_stars) {
    StarCriteria criteria;
    criteria.contrast = settings.star_contrast;
    criteria.least_light = threshold_;
    criteria.center_x = static_cast<int>(center_[0]);
    criteria.center_y = static_cast<int>(center_[1]);
    criteria.protected_radius = nucleus_fraction * std::min(picture.width, picture.height);
    pixels_of_stars_ = remove_foreground_stars(picture_, criteria);
  }
  // Beyond the picture there is no light, however far a galaxy is said to reach.
  radius_ = whole_radius(picture_, plane_);
  if (settings.radius_pixels) {
    radius_ = std::min(radius_, *settings.radius_pixels / file_pixels * plane_.pixel_size());
  }
  darken_noise();
  // What fades is no lane: dust is found before, and fades as the light does.
  const std::vector<double> kept = kept_of_pixels(settings);
  take_dust_away(settings, kept);
  multiply(kept);
  center_color_ = mean_light_within(std::max(settings.bulge_radius_kpc, plane_.pixel_size()));
  if (!(total_light() > 0)) {
    throw DataError(
        "no pixel of the picture is brighter than its sky, expected a galaxy on a darker "
        "background; check the picture, or lower the threshold");
  }
}

// From half to one and a half thresholds: a sharp limit would show as an edge.
void LightMap::darken_noise() {
  if (!(threshold_ > 0)) return;
  std::vector<double> kept;
  for (int y = 0; y < picture_.height; ++y) {
    for (int x = 0; x < picture_.width; ++x)
      kept.push_back(smooth_step(mean(light_at(picture_, x, y)) / threshold_ - 0.5));
  }
  multiply(kept);
}

std::vector<double> LightMap::kept_of_pixels(const GalaxySettings& settings) const {
  const double border =
      std::max(1.0, settings.border_fade * std::min(picture_.width, picture_.height));
  std::vector<double> kept;
  for (int y = 0; y < picture_.height; ++y) {
    for (int x = 0; x < picture_.width; ++x) {
      const DiskPlane::Point disk = plane_.in_disk({x + 0.5, y + 0.5});
      const int edge = std::min({x, y, picture_.width - 1 - x, picture_.height - 1 - y});
      const double inside = radius_ - std::hypot(disk[0], disk[1]);
      kept.push_back(smooth_step((edge + 0.5) / border) *
                     smooth_step(inside / (rim_fraction * radius_)));
    }
  }
  return kept;
}

void LightMap::multiply(const std::vector<double>& factors) {
  for (std::size_t i = 0; i < picture_.pixels.size(); ++i) {
    if (i % 4 != 3)
      picture_.pixels[i] =
          static_cast<float>(factors[i / 4] * static_cast<double>(picture_.pixels[i]));
  }
}

void LightMap::take_dust_away(const GalaxySettings& settings, const std::vector<double>& kept) {
  const double lane = lane_fraction * radius_ / plane_.pixel_size();
  const double faintest =
      std::max(2 * threshold_, faint_fraction * mean(mean_light_within(half_fraction * radius_)));
  dust_.emplace(picture_, settings, lane, faintest);
  dust_->multiply(kept);
  dust_->unveil(picture_);
}

Light LightMap::mean_light_within(double radius) const {
  Light sum = {0, 0, 0};
  int count = 0;
  for (int y = 0; y < picture_.height; ++y) {
    for (int x = 0; x < picture_.width; ++x) {
      const DiskPlane::Point disk = plane_.in_disk({x + 0.5, y + 0.5});
      if (std::hypot(disk[0], disk[1]) > radius) continue;
      const Light light = light_at(picture_, x, y);
      for (std::size_t i = 0; i < 3; ++i)
        sum[i] += light[i];
      ++count;
    }
  }
  return count > 0 ? (1.0 / count) * sum : sum;
}

double LightMap::total_light() const {
  double sum = 0;
  for (int y = 0; y < picture_.height; ++y) {
    for (int x = 0; x < picture_.width; ++x)
      sum += mean(light_at(picture_, x, y));
  }
  return sum * plane_.area_of_pixel();
}

Light LightMap::at(const DiskPlane::Point& disk) const {
  const DiskPlane::Point pixel = plane_.in_picture(disk);
  const bool inside =
      pixel[0] >= 0 && pixel[1] >= 0 && pixel[0] < picture_.width && pixel[1] < picture_.height;
  if (!inside) return {0, 0, 0};
  return light_at(picture_, static_cast<int>(pixel[0]), static_cast<int>(pixel[1]));
}

}  // namespace splotchcl
