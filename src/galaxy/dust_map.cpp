#include "galaxy/dust_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "galaxy/even_points.h"

namespace splotchcl {
namespace {

constexpr int knots = 1025;
constexpr double step = 1.0 / 64;

}  // namespace

Veil::Veil(double dust_height, double star_height) {
  constexpr int parts = 64;
  for (int i = 0; i < parts; ++i) {
    const double height = star_height * normal_quantile((i + 0.5) / parts);
    dust_above_.push_back(dust_height > 0 ? 0.5 * std::erfc(height / dust_height * M_SQRT1_2)
                                          : (height < 0 ? 1.0 : 0.0));
  }
  for (int knot = 0; knot < knots; ++knot)
    transmission_.push_back(exact_transmission(knot * step));
}

double Veil::exact_transmission(double depth) const {
  double sum = 0;
  for (const double part : dust_above_)
    sum += std::exp(-depth * part);
  return sum / static_cast<double>(dust_above_.size());
}

double Veil::transmission(double depth) const {
  const double knot = depth / step;
  if (!(knot < knots - 1)) return exact_transmission(depth);
  const auto i = static_cast<std::size_t>(knot);
  const double part = knot - static_cast<double>(i);
  return (1 - part) * transmission_[i] + part * transmission_[i + 1];
}

double Veil::depth(double transmission, double largest) const {
  const auto below =
      std::lower_bound(transmission_.begin(), transmission_.end(), transmission, std::greater<>());
  if (below == transmission_.begin()) return 0;
  if (below == transmission_.end()) return largest;
  const double part = (below[-1] - transmission) / (below[-1] - below[0]);
  const auto i = static_cast<double>(below - transmission_.begin() - 1);
  return std::min(largest, (i + part) * step);
}

namespace {

// weights[i] is that of what lies i away.
std::vector<double> gaussian_weights(double deviation) {
  constexpr double farthest = 3;  // deviations
  std::vector<double> weights;
  for (int i = 0; i <= std::ceil(farthest * deviation); ++i)
    weights.push_back(std::exp(-i * i / (2 * deviation * deviation)));
  return weights;
}

// One line of `count` values, `stride` apart.
void blur_line(const double* in, double* out, int count, std::size_t stride,
               const std::vector<double>& weights) {
  const int reach = static_cast<int>(weights.size()) - 1;
  for (int i = 0; i < count; ++i) {
    double sum = 0, weight = 0;
    for (int j = std::max(0, i - reach); j <= std::min(count - 1, i + reach); ++j) {
      const double share = weights[static_cast<std::size_t>(std::abs(i - j))];
      sum += share * in[static_cast<std::size_t>(j) * stride];
      weight += share;
    }
    out[static_cast<std::size_t>(i) * stride] = sum / weight;
  }
}

// The mean over a Gaussian of this standard deviation in pixels around each of a picture's values,
// rows from the top; what lies outside of the picture does not count.
std::vector<double> blurred(const std::vector<double>& values, int width, double deviation) {
  if (!(deviation > 0)) return values;
  const std::vector<double> weights = gaussian_weights(deviation);
  const auto across = static_cast<std::size_t>(width);
  const int height = static_cast<int>(values.size() / across);
  std::vector<double> rows(values.size()), result(values.size());
  for (int y = 0; y < height; ++y) {
    const std::size_t first = static_cast<std::size_t>(y) * across;
    blur_line(&values[first], &rows[first], width, 1, weights);
  }
  for (std::size_t x = 0; x < across; ++x)
    blur_line(&rows[x], &result[x], height, across, weights);
  return result;
}

constexpr double base_depth = 0.4;    // between the lanes, where there is most light
constexpr double deepest_lane = 2.5;  // of a lane: it hides what lies behind
constexpr double noise = 0.05;        // by which light varies without dust, in logarithms
constexpr double knot = 0.35;         // above its surroundings, in logarithms, light is a knot's
constexpr double sharpness = 1;       // pixels by which the map is smoothed

// Logarithms of each pixel's light; what is faint is as dark as `faintest`.
std::vector<double> logarithms(const Image& picture, double faintest) {
  std::vector<double> values;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x)
      values.push_back(std::log(mean(light_at(picture, x, y)) + faintest));
  }
  return values;
}

// What the surroundings of each pixel would show without lanes: the mean over where they are
// bright. Logarithms, because the mean of a disk's light would lie above it.
std::vector<double> surroundings(const std::vector<double>& light, int width, double deviation) {
  std::vector<double> level = blurred(light, width, deviation);
  constexpr int rounds = 3;
  for (int round = 0; round < rounds; ++round) {
    std::vector<double> bright(light.size());
    for (std::size_t i = 0; i < light.size(); ++i)
      bright[i] = std::clamp(light[i], level[i], level[i] + knot);
    level = blurred(bright, width, deviation);
  }
  return level;
}

// The mean brightness at which the galaxy gives off its light.
double typical_light(const std::vector<double>& logarithms, double faintest) {
  double sum = 0, squares = 0;
  for (const double logarithm : logarithms) {
    const double light = std::exp(logarithm) - faintest;
    sum += light;
    squares += light * light;
  }
  return sum > 0 ? squares / sum : 0;
}

bool is_gray(const Image& picture) {
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const float* const pixel = picture.at(x, y);
      if (pixel[0] != pixel[1] || pixel[0] != pixel[2]) return false;
    }
  }
  return true;
}

}  // namespace

DustMap::DustMap(const Image& picture, const GalaxySettings& settings, double width,
                 double faintest)
    : width_(picture.width),
      opacity_(is_gray(picture) ? Light{1, 1, 1} : dust_opacity),
      veil_(settings.dust_height_kpc, std::max(settings.gas_height_kpc, 1e-6)),
      depths_(picture.pixels.size() / 4) {
  if (!(settings.dust > 0)) return;
  const std::vector<double> light = logarithms(picture, faintest);
  const std::vector<double> level = surroundings(light, width_, width);
  const double typical = typical_light(light, faintest);
  for (std::size_t i = 0; i < depths_.size(); ++i) {
    const double around = std::max(0.0, std::exp(level[i]) - faintest);
    const double base = base_depth * std::sqrt(around / (around + typical));
    const double darker = std::max(0.0, level[i] - light[i] - noise);
    const double lane = veil_.depth(std::exp(-darker), deepest_lane);
    // At the rim the logarithm of what is faint tells of the sky alone.
    const double told = around / (around + faintest);
    depths_[i] = settings.dust * told * (base + lane);
  }
  depths_ = blurred(depths_, width_, sharpness);
}

void DustMap::multiply(const std::vector<double>& factors) {
  for (std::size_t i = 0; i < depths_.size(); ++i)
    depths_[i] *= factors[i];
}

void DustMap::unveil(Image& picture) const {
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      float* const pixel = picture.at(x, y);
      for (std::size_t i = 0; i < 3; ++i) {
        pixel[i] = static_cast<float>(static_cast<double>(pixel[i]) /
                                      veil_.transmission(opacity_[i] * depth(x, y)));
      }
    }
  }
}

}  // namespace splotchcl
