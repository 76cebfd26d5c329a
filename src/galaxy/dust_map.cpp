#include "galaxy/dust_map.h"

#include <algorithm>
#include <cmath>

#include "galaxy/blur.h"

namespace splotchcl {
namespace {

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
