#include "publish/viewer_picture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "parallel/for_blocks.h"

namespace splotchcl {
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

}  // namespace splotchcl
