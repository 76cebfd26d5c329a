#include "publish/viewer_splats.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <utility>

#include "finish/tone.h"
#include "parallel/for_blocks.h"

namespace splotchcl {
namespace {

double dot(const Vec3& axis, const std::array<float, 3>& place) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i)
    sum += axis.a[i] * static_cast<double>(place[i]);
  return sum;
}

float brightest(const LightSplat& splat) {
  return std::max({splat.light[0], splat.light[1], splat.light[2]});
}

// The display values of the splats' hues, as bright as can be. Light that is near white may have no
// hue any more: bright splats are shown as bright as they are.
Image shown_hues(const std::vector<LightSplat>& splats, double white, double least,
                 const DisplayLight& display) {
  Image image(static_cast<int>(splats.size()), 1);
  for (std::size_t i = 0; i < splats.size(); ++i) {
    const auto most = static_cast<double>(brightest(splats[i]));
    const double factor = white * std::clamp(most / white, least, 1.0) / most;
    for (std::size_t channel = 0; channel < 3; ++channel)
      image.pixels[4 * i + channel] =
          static_cast<float>(factor * static_cast<double>(splats[i].light[channel]));
  }
  image = displayed(std::move(image), display);
  for (std::size_t i = 0; i < splats.size(); ++i) {
    float* const color = &image.pixels[4 * i];
    const float most = std::max({color[0], color[1], color[2]});
    for (std::size_t channel = 0; most > 0 && channel < 3; ++channel)
      color[channel] /= most;
  }
  return image;
}

double unexposed_white(const FinishSettings& finish) {
  return finish.white.value_or(1) * std::exp2(-finish.exposure.value_or(0));
}

}  // namespace

Image displayed(Image light, const DisplayLight& display) {
  adjust_light(light, display.finish, display.gamma);
  for (float& value : light.pixels) {
    const float shown = std::clamp(value, 0.0F, 1.0F);
    value = static_cast<float>(std::pow(static_cast<double>(shown), 1 / display.gamma));
  }
  return light;
}

std::vector<ViewerSplat> viewer_splats(const std::vector<LightSplat>& splats, const Frame& frame,
                                       const DisplayLight& display, const LightToOpacity& opacity) {
  const CameraFrame& camera = frame.camera;
  const double white = unexposed_white(display.finish);
  const double per_length = camera.pixels_per_length / (0.5 * frame.width);
  const Image colors = shown_hues(splats, white, opacity.hue_at, display);
  std::vector<ViewerSplat> shown(splats.size());
  for (std::size_t i = 0; i < splats.size(); ++i) {
    const LightSplat& splat = splats[i];
    std::size_t axis = 0;
    for (const Vec3* const direction : {&camera.right, &camera.down, &camera.forward})
      shown[i].place[axis++] = static_cast<float>(per_length * dot(*direction, splat.place));
    // A profile's power is a wider or narrower Gaussian.
    shown[i].deviation = static_cast<float>(per_length * static_cast<double>(splat.sigma) /
                                            std::sqrt(2 * opacity.exponent));
    std::copy_n(&colors.pixels[4 * i], 3, shown[i].color.begin());
    const double light = opacity.gain * static_cast<double>(brightest(splat)) / white;
    shown[i].opacity = static_cast<float>(-std::expm1(-std::pow(light, opacity.exponent)));
  }
  return shown;
}

namespace {

constexpr float widening = 0.3F;  // pixels squared
constexpr float least_step = 1.0F / 255;
constexpr float most_opacity = 0.99F;
constexpr float nearest = 0.01F;
constexpr std::size_t rows_at_once = 16;

// A splat in the picture.
struct Spot {
  float depth = 0;
  float x = 0, y = 0, variance = 0, radius = 0;  // pixels
  const ViewerSplat* splat = nullptr;
};

Spot spot_of(const ViewerSplat& splat, const Frame& frame) {
  const auto half = 0.5F * static_cast<float>(frame.width);
  const float distance = static_cast<float>(frame.camera.focal_pixels) / half;
  const bool is_flat = frame.projection == Projection::orthographic;
  Spot spot;
  spot.splat = &splat;
  spot.depth = splat.place[2] + distance;
  const float scale = is_flat ? half : half * distance / spot.depth;
  spot.x = static_cast<float>(frame.camera.center_x) + scale * splat.place[0];
  spot.y = static_cast<float>(frame.camera.center_y) + scale * splat.place[1];
  spot.variance = scale * scale * splat.deviation * splat.deviation + widening;
  const float cut = std::min(2 * std::log(splat.opacity / least_step), 9.0F);
  const bool is_seen = splat.opacity > least_step && spot.depth > nearest;
  spot.radius = is_seen ? std::sqrt(spot.variance * cut) : 0;
  return spot;
}

std::vector<Spot> spots_by_depth(const std::vector<ViewerSplat>& splats, const Frame& frame) {
  std::vector<Spot> spots;
  spots.reserve(splats.size());
  for (const ViewerSplat& splat : splats) {
    const Spot spot = spot_of(splat, frame);
    if (spot.radius > 0) spots.push_back(spot);
  }
  std::stable_sort(spots.begin(), spots.end(),
                   [](const Spot& a, const Spot& b) { return a.depth < b.depth; });
  return spots;
}

// The first and the last pixel whose middle lies within the radius, among those of the picture.
struct Span {
  int first, end;
};
Span span_of(float middle, float radius, int first, int end) {
  const auto bound = [&](float place) {
    return static_cast<int>(
        std::clamp(std::ceil(place - 0.5F), static_cast<float>(first), static_cast<float>(end)));
  };
  return {bound(middle - radius), bound(middle + radius)};
}

// Alpha holds what is let through until all is drawn.
void put(Image& image, const Spot& spot, Span rows) {
  const Span columns = span_of(spot.x, spot.radius, 0, image.width);
  for (int y = rows.first; y < rows.end; ++y) {
    for (int x = columns.first; x < columns.end; ++x) {
      const float right = static_cast<float>(x) + 0.5F - spot.x;
      const float down = static_cast<float>(y) + 0.5F - spot.y;
      const float part = std::exp(-0.5F * (right * right + down * down) / spot.variance);
      const float opacity = std::min(spot.splat->opacity * part, most_opacity);
      if (opacity < least_step) continue;
      float* const pixel = image.at(x, y);
      for (std::size_t channel = 0; channel < 3; ++channel)
        pixel[channel] += pixel[3] * opacity * spot.splat->color[channel];
      pixel[3] *= 1 - opacity;
    }
  }
}

}  // namespace

Image picture_of_viewers(const std::vector<ViewerSplat>& splats, const Frame& frame) {
  const std::vector<Spot> spots = spots_by_depth(splats, frame);
  Image image(frame.width, frame.height);
  for (std::size_t i = 3; i < image.pixels.size(); i += 4)
    image.pixels[i] = 1;
  for_blocks(static_cast<std::size_t>(frame.height), rows_at_once,
             [&](std::size_t first, std::size_t end) {
               for (const Spot& spot : spots)
                 put(image, spot,
                     span_of(spot.y, spot.radius, static_cast<int>(first), static_cast<int>(end)));
             });
  for (std::size_t i = 3; i < image.pixels.size(); i += 4)
    image.pixels[i] = 1 - image.pixels[i];
  return image;
}

namespace {

constexpr std::array<double, 5> first_gains = {1.0 / 4, 1.0 / 2, 1, 2, 4};
constexpr std::array<double, 3> hues_at = {1.0 / 32, 1.0 / 2, 1};
constexpr double gain_step = 1.2;
constexpr int most_steps = 16;

class Trials {
 public:
  Trials(const std::vector<LightSplat>& splats, const Frame& frame, const Image& shown,
         const DisplayLight& display)
      : splats_(splats), frame_(frame), shown_(shown), display_(display) {}

  // Whether this is nearer than all before.
  bool improves(const LightToOpacity& opacity) {
    NearestSplats tried;
    tried.opacity = opacity;
    tried.splats = viewer_splats(splats_, frame_, display_, opacity);
    measure(picture_of_viewers(tried.splats, frame_), tried);
    const bool is_nearer = !has_any_ || tried.rms_difference < best_.rms_difference;
    if (is_nearer) best_ = std::move(tried);
    has_any_ = true;
    return is_nearer;
  }

  // From the best gain up and down, as long as that helps.
  void refine() {
    const LightToOpacity from = best_.opacity;
    for (const double step : {gain_step, 1 / gain_step}) {
      LightToOpacity next = from;
      for (int i = 0; i < most_steps; ++i) {
        next.gain *= step;
        if (!improves(next)) break;
      }
    }
  }

  const NearestSplats& best() const { return best_; }

 private:
  void measure(const Image& picture, NearestSplats& tried) const {
    double sum = 0, largest = 0;
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
      if (i % 4 == 3) continue;
      const double difference =
          std::abs(static_cast<double>(picture.pixels[i]) - static_cast<double>(shown_.pixels[i]));
      sum += difference * difference;
      largest = std::max(largest, difference);
    }
    const double values = 0.75 * static_cast<double>(picture.pixels.size());
    tried.rms_difference = std::sqrt(sum / std::max(values, 1.0));
    tried.largest_difference = largest;
  }

  const std::vector<LightSplat>& splats_;
  const Frame& frame_;
  const Image& shown_;
  const DisplayLight& display_;
  NearestSplats best_;
  bool has_any_ = false;
};

}  // namespace

NearestSplats nearest_splats(const std::vector<LightSplat>& splats, const Frame& frame,
                             const Image& exact, const DisplayLight& display) {
  const Image shown = displayed(exact, display);
  Trials trials(splats, frame, shown, display);
  std::set<double> exponents = {1, std::min(1 / display.gamma, 1.0)};
  exponents.insert(std::sqrt(*exponents.begin()));
  for (const double exponent : exponents) {
    for (const double gain : first_gains)
      trials.improves({gain, exponent});
  }
  const LightToOpacity best = trials.best().opacity;
  for (const double hue_at : hues_at)
    trials.improves({best.gain, best.exponent, hue_at});
  trials.refine();
  return trials.best();
}

}  // namespace splotchcl
