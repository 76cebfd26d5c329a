#include "splotchcl/compare.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "splotchcl/error.h"

namespace splotchcl {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Sums of one channel, from which its figures follow.
struct ChannelSums {
  double maximum = 0;
  double difference_squared = 0;
  double reference_squared = 0;

  void add(double difference, double reference) {
    maximum = std::max(maximum, difference);
    difference_squared += difference * difference;
    reference_squared += reference * reference;
  }
  void add(const ChannelSums& other) {
    maximum = std::max(maximum, other.maximum);
    difference_squared += other.difference_squared;
    reference_squared += other.reference_squared;
  }
};

ChannelDifference figures(const ChannelSums& sums, double values) {
  ChannelDifference result;
  result.maximum = sums.maximum;
  if (values > 0) result.rms = std::sqrt(sums.difference_squared / values);
  result.psnr = -20 * std::log10(result.rms);
  if (sums.difference_squared > 0) {
    result.relative_l2 = std::sqrt(sums.difference_squared / sums.reference_squared);
  }
  return result;
}

double distance(float a, float b) {
  return std::isfinite(a) && std::isfinite(b)
             ? std::abs(static_cast<double>(a) - static_cast<double>(b))
             : infinity;
}

void check_sizes(const Image& image, const Image& reference) {
  if (image.width == reference.width && image.height == reference.height) return;
  const auto size = [](const Image& i) {
    return std::to_string(i.width) + "x" + std::to_string(i.height);
  };
  throw UsageError("the pictures differ in size, " + size(image) + " and " + size(reference) +
                   ": only pictures of the same size can be compared");
}

}  // namespace

ImageDifference compare_images(const Image& image, const Image& reference, double limit,
                               ComparedChannels compared) {
  check_sizes(image, reference);
  ImageDifference result;
  result.channels_compared = compared == ComparedChannels::rgba ? 4 : 3;
  std::array<ChannelSums, 4> sums;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      bool beyond = false;
      bool finite = true;
      for (int channel = 0; channel < result.channels_compared; ++channel) {
        const float a = image.at(x, y)[channel];
        const float b = reference.at(x, y)[channel];
        const double difference = distance(a, b);
        const double scale = std::isfinite(b) ? std::max(1.0, std::abs(double{b})) : 1.0;
        sums[static_cast<std::size_t>(channel)].add(difference, std::isfinite(b) ? b : 0.0);
        finite = finite && std::isfinite(difference);
        beyond = beyond || !(difference <= limit * scale) || !std::isfinite(difference);
        if (difference / scale > result.worst) {
          result.worst = difference / scale;
          result.worst_x = x;
          result.worst_y = y;
          result.worst_channel = channel;
        }
      }
      ++result.pixels;
      if (beyond) ++result.pixels_beyond;
      if (!finite) ++result.pixels_not_finite;
    }
  }
  ChannelSums total;
  const auto pixels = static_cast<double>(result.pixels);
  for (std::size_t channel = 0; channel < 4; ++channel) {
    result.channels[channel] = figures(sums[channel], pixels);
    total.add(sums[channel]);
  }
  result.overall = figures(total, pixels * result.channels_compared);
  return result;
}

Image difference_image(const Image& image, const Image& reference, double white) {
  check_sizes(image, reference);
  Image result(image.width, image.height);
  const std::size_t pixels = result.pixels.size() / 4;
  for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
    float* out = &result.pixels[4 * pixel];
    bool finite = true;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const float value = image.pixels[4 * pixel + channel];
      const float expected = reference.pixels[4 * pixel + channel];
      const double difference = distance(value, expected);
      finite = finite && std::isfinite(difference);
      const double part = difference > 0 ? 0.5 * difference / white : 0.0;
      out[channel] = static_cast<float>(value < expected ? 0.5 - part : 0.5 + part);
    }
    if (!finite) {
      out[0] = out[2] = 1;
      out[1] = 0;
    }
    out[3] = 1;
  }
  return result;
}

}  // namespace splotchcl
