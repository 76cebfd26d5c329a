#pragma once

#include <optional>

namespace splotchcl {

enum class Codec { h264, h265, vp9 };

// How a film is made of its frames.
struct MovieSettings {
  std::optional<int> frames;  // unset: as many as the path has
  double frames_per_second = 25;
  std::optional<Codec> codec;  // unset: VP9 for .webm, else H.264
  // The encoder's constant rate factor: 0 loses nothing, or nearly, 51 nearly all.
  int rate_factor = 18;
};

}  // namespace splotchcl
