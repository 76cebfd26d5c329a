#pragma once

#include <cstddef>
#include <vector>

namespace splotchcl {

// What the error of a block of pixels is made of, over what is promised there.
struct ErrorParts {
  double ends = 0;   // of splats, in uneven light
  double even = 0;   // of splats, in even light
  double peaks = 0;  // errors that are parts of splats' peaks
  double slabs = 0;  // wide splats that are not in order, ordered
  double rest = 0;   // layers and early stop, ordered

  double sum() const { return ends + even + peaks + slabs + rest; }
};

// The largest |frame - reference| / max(1, |reference|) in each square block of pixels of a drawn
// picture, row by row.
struct BlockErrors {
  static constexpr int block_pixels = 16;  // on each side

  BlockErrors() = default;
  // Of a picture of so many pixels.
  BlockErrors(int width, int height)
      : columns(blocks_along(width)),
        rows(blocks_along(height)),
        errors(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows)) {}

  static constexpr int blocks_along(int pixels) {
    return (pixels + block_pixels - 1) / block_pixels;
  }
  // Of a picture's pixel.
  float at(int x, int y) const {
    return errors[static_cast<std::size_t>(y / block_pixels) * static_cast<std::size_t>(columns) +
                  static_cast<std::size_t>(x / block_pixels)];
  }

  int columns = 0, rows = 0;
  std::vector<float> errors;
};

// What was found of a frame's errors after it had been drawn, from all of its splats
// (docs/dev/accuracy.md, "Checked after drawing").
struct FrameCheck {
  bool is_bound = false;  // else an estimate
  // The largest error of any pixel over what is promised, of each drawing in turn. The frame is
  // drawn again until it is at most 1. In extended precision it is what that promises for any
  // splats.
  std::vector<double> errors_of_promise;
  ErrorParts worst;    // where the last one is largest
  BlockErrors blocks;  // of the crop, in the last drawing
};

}  // namespace splotchcl
