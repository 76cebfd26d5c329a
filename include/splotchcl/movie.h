#pragma once

#include <optional>

namespace splotchcl {

// H.264, H.265 (HEVC) and VP9, as ffmpeg's libx264, libx265 and libvpx-vp9 make them.
enum class Codec { h264, h265, vp9 };

// How a film is made of its frames.
struct MovieSettings {
  std::optional<int> frames;      // >= 1; unset: as many as the path has
  double frames_per_second = 25;  // 0.01 to 1000
  std::optional<Codec> codec;     // unset: VP9 for .webm, else H.264
  // The encoder's constant rate factor: from 0, which loses nothing, or nearly, to 51, nearly all.
  int rate_factor = 18;
  int bits = 8;  // of each channel, or 10
};

}  // namespace splotchcl
