#include "finish/layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "splotchcl/error.h"

namespace splotchcl {
namespace {

constexpr double margin_part = 0.032;  // of the shorter side

bool overlap(const Box& a, const Box& b) {
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

}  // namespace

bool is_at_top(Anchor anchor) {
  return anchor == Anchor::top_left || anchor == Anchor::top || anchor == Anchor::top_right;
}
bool is_at_bottom(Anchor anchor) {
  return anchor == Anchor::bottom_left || anchor == Anchor::bottom ||
         anchor == Anchor::bottom_right;
}
bool is_at_left(Anchor anchor) {
  return anchor == Anchor::top_left || anchor == Anchor::left || anchor == Anchor::bottom_left;
}
bool is_at_right(Anchor anchor) {
  return anchor == Anchor::top_right || anchor == Anchor::right || anchor == Anchor::bottom_right;
}

Layout::Layout(int width, int height)
    : width_(width),
      height_(height),
      unit_(std::min(width, height)),
      margin_(std::round(margin_part * unit_)) {}

Box Layout::place(Anchor anchor, double width, double height, const std::string& what) {
  double& used = used_[static_cast<std::size_t>(anchor)];
  const bool is_stacked = is_at_top(anchor) || is_at_bottom(anchor);
  const double room_x = width_ - 2 * margin_ - (is_stacked ? 0 : used);
  const double room_y = height_ - 2 * margin_ - (is_stacked ? used : 0);
  if (width > room_x || height > room_y) {
    throw UsageError(fmt::format(
        "{}: takes {:.0f} x {:.0f} pixels, expected at most {:.0f} x {:.0f}, which the picture "
        "has left there; make it smaller, or put it to another place (at)",
        what, width, height, room_x, room_y));
  }
  Box box;
  const double depth_x = is_stacked ? 0 : used, depth_y = is_stacked ? used : 0;
  box.left = is_at_left(anchor)    ? margin_ + depth_x
             : is_at_right(anchor) ? width_ - margin_ - depth_x - width
                                   : (width_ - width) / 2;
  box.top = is_at_top(anchor)      ? margin_ + depth_y
            : is_at_bottom(anchor) ? height_ - margin_ - depth_y - height
                                   : (height_ - height) / 2;
  box.left = std::round(box.left);
  box.top = std::round(box.top);
  box.right = box.left + width;
  box.bottom = box.top + height;
  used += (is_stacked ? height : width) + margin_;
  for (const auto& [other, name] : placed_) {
    if (!overlap(box, other)) continue;
    throw UsageError(fmt::format(
        "{}: would lie upon {}; make one of them smaller, or put it to another place (at)", what,
        name));
  }
  placed_.emplace_back(box, what);
  return box;
}

}  // namespace splotchcl
