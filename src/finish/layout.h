#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "finish/canvas.h"
#include "splotchcl/finish.h"

namespace splotchcl {

// Finds room for what is put upon a picture. Things at the same anchor stand below each
// other: at the top from the edge downwards, at the bottom upwards, and at the left and
// right, in the middle of their height, beside each other.
class Layout {
 public:
  Layout(int width, int height);

  // The shorter side in pixels, which sizes of letters and lines are parts of.
  double unit() const { return unit_; }

  // Room of this size. Throws UsageError, naming `what`, where the picture has too little or
  // something else lies there.
  Box place(Anchor anchor, double width, double height, const std::string& what);

 private:
  double width_, height_, unit_, margin_;
  std::array<double, 8> used_{};  // depth from the margin inwards, by anchor
  std::vector<std::pair<Box, std::string>> placed_;
};

bool is_at_top(Anchor anchor);
bool is_at_bottom(Anchor anchor);
bool is_at_left(Anchor anchor);
bool is_at_right(Anchor anchor);

}  // namespace splotchcl
