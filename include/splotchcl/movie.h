#pragma once

#include <optional>
#include <string>

namespace splotchcl {

// H.264, H.265 (HEVC), VP9 and AV1 are to be shown. ProRes (422 HQ) and DNxHR (HQ, or HQX of 10
// bits) are to be edited, HAP (Q) is for players of many screens, and FFV1 is lossless.
enum class Codec { h264, h265, vp9, av1, prores, dnxhr, hap, ffv1 };

// Each frame is the mean of pictures while a shutter is open.
struct MotionBlur {
  double shutter = 0.5;  // the part of the time from frame to frame, > 0 and at most 1
  int samples = 8;       // pictures for each frame, at least 2
};

// How a film is made of its frames.
struct MovieSettings {
  std::optional<int> frames;      // >= 1; unset: as many as the path has
  double frames_per_second = 25;  // 0.01 to 1000
  std::optional<Codec> codec;     // unset: VP9 for .webm, else H.264
  std::string audio;              // a file whose sound lies under the film; empty: none
  std::optional<MotionBlur> motion_blur;
  // The encoder's constant rate factor: from 0, which loses nothing, or nearly, to 51, nearly all.
  int rate_factor = 18;
  int bits = 8;  // of each channel, or 10
};

}  // namespace splotchcl
