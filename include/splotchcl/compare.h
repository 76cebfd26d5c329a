#pragma once

#include <array>
#include <cstdint>

#include "splotchcl/image.h"

namespace splotchcl {

// How far one channel, or all of them together, lies from the reference.
struct ChannelDifference {
  double maximum = 0;      // of |a - b|
  double rms = 0;          // the square root of the mean of (a - b)^2
  double psnr = 0;         // decibels, 20 log10(1 / rms): the peak is the display's white
  double relative_l2 = 0;  // |a - b| / |b| as Euclidean norms over the picture
};

// The tolerance of a frame is |a - b| <= limit * max(1, |b|) for every pixel and channel,
// b the reference. `worst` is the largest |a - b| / max(1, |b|), where it is, and whose.
// A value that is not finite, in either picture, lies infinitely far off.
struct ImageDifference {
  std::array<ChannelDifference, 4> channels;  // red, green, blue, alpha
  ChannelDifference overall;                  // of the channels compared
  int channels_compared = 4;                  // 3: alpha left out
  double worst = 0;
  int worst_x = 0, worst_y = 0, worst_channel = 0;
  std::uint64_t pixels = 0;
  std::uint64_t pixels_beyond = 0;      // with a channel beyond the limit
  std::uint64_t pixels_not_finite = 0;  // with a value that is not finite
};

enum class ComparedChannels { rgb, rgba };

// Throws UsageError, naming both sizes, when they differ.
ImageDifference compare_images(const Image& image, const Image& reference, double limit = 0,
                               ComparedChannels compared = ComparedChannels::rgba);

// a - b of red, green and blue: 1/2 where they are equal, 1 where a is larger by `white`, 0 where
// it is smaller by as much; magenta where not finite; opaque.
Image difference_image(const Image& image, const Image& reference, double white);

}  // namespace splotchcl
