#include "film/path_plot/plot_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace splotchcl {
namespace {

constexpr Light frame_light = {0.3F, 0.3F, 0.3F};
constexpr double text_size = 17;

// 1, 2 or 5 times a power of ten, so that about five of them make the length.
double tick_step(double length) {
  const double rough = length / 5;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough) return factor * power;
  }
  return 10 * power;
}

double distance_to_segment(const PlotPoint& p, const PlotPoint& a, const PlotPoint& b) {
  const double x = b.x - a.x, y = b.y - a.y;
  const double length = x * x + y * y;
  const double along = length > 0 ? ((p.x - a.x) * x + (p.y - a.y) * y) / length : 0;
  const double t = std::clamp(along, 0.0, 1.0);
  return std::hypot(p.x - a.x - t * x, p.y - a.y - t * y);
}

}  // namespace

PlotPanel::PlotPanel(Image& image, const Rectangle& square, std::size_t horizontal,
                     std::size_t vertical, const Vec3& center, double pixels_per_length)
    : image_(image),
      canvas_(image, {0, 0, image.width, image.height}),
      square_(square),
      horizontal_(horizontal),
      vertical_(vertical),
      center_(center),
      pixels_per_length_(pixels_per_length) {}

PlotPoint PlotPanel::place(const Vec3& position) const {
  return {square_.x + 0.5 * square_.width +
              pixels_per_length_ * (position.a[horizontal_] - center_.a[horizontal_]),
          square_.y + 0.5 * square_.height -
              pixels_per_length_ * (position.a[vertical_] - center_.a[vertical_])};
}

PlotPoint PlotPanel::corner() const {
  return {static_cast<double>(square_.x), static_cast<double>(square_.y)};
}

// Pixels nearer to a line than half its width; those at its edge in part.
template <class Distance>
void PlotPanel::shape(const PlotPoint& low, const PlotPoint& high, double half_width,
                      const Light& light, float opacity, Distance distance) {
  const double margin = half_width + 1;
  const auto inside = [](double value, int from, int size) {
    return static_cast<int>(std::clamp<double>(value, from, from + size));
  };
  const int x_end = inside(std::ceil(high.x + margin), square_.x, square_.width);
  const int y_end = inside(std::ceil(high.y + margin), square_.y, square_.height);
  for (int y = inside(low.y - margin, square_.y, square_.height); y < y_end; ++y) {
    for (int x = inside(low.x - margin, square_.x, square_.width); x < x_end; ++x) {
      const double inner = half_width + 0.5 - distance(PlotPoint{x + 0.5, y + 0.5});
      if (inner <= 0) continue;
      canvas_.cover(x, y, light, opacity * static_cast<float>(std::min(1.0, inner)));
    }
  }
}

void PlotPanel::line(const PlotPoint& from, const PlotPoint& to, double width, const Light& light,
                     float opacity) {
  const PlotPoint low = {std::min(from.x, to.x), std::min(from.y, to.y)};
  const PlotPoint high = {std::max(from.x, to.x), std::max(from.y, to.y)};
  shape(low, high, 0.5 * width, light, opacity,
        [&](const PlotPoint& p) { return distance_to_segment(p, from, to); });
}

void PlotPanel::disc(const PlotPoint& center, double radius, const Light& light) {
  shape(center, center, radius, light, 1,
        [&](const PlotPoint& p) { return std::hypot(p.x - center.x, p.y - center.y); });
}

void PlotPanel::ring(const PlotPoint& center, double radius, double width, const Light& light) {
  const PlotPoint low = {center.x - radius, center.y - radius};
  const PlotPoint high = {center.x + radius, center.y + radius};
  shape(low, high, 0.5 * width, light, 1, [&](const PlotPoint& p) {
    return std::abs(std::hypot(p.x - center.x, p.y - center.y) - radius);
  });
}

void PlotPanel::arrow(const PlotPoint& from, const PlotPoint& to, double width,
                      const Light& light) {
  line(from, to, width, light);
  const double x = to.x - from.x, y = to.y - from.y;
  const double length = std::hypot(x, y);
  const double head = std::min(7.0, 0.5 * length);
  if (!(length > 2)) return;  // seen from its tip
  const double ux = head * x / length, uy = head * y / length;
  line(to, {to.x - ux + 0.5 * uy, to.y - uy - 0.5 * ux}, width, light);
  line(to, {to.x - ux - 0.5 * uy, to.y - uy + 0.5 * ux}, width, light);
}

void PlotPanel::add_light(const PlotPoint& point, const Light& light) {
  const double x = point.x - square_.x, y = point.y - square_.y;
  if (!(x >= 0 && x < square_.width && y >= 0 && y < square_.height)) return;
  float* const pixel = image_.at(square_.x + static_cast<int>(x), square_.y + static_cast<int>(y));
  for (std::size_t i = 0; i < 3; ++i)
    pixel[i] += light[i];
}

void PlotPanel::label(const PlotPoint& point, const std::string& text, const Font& font,
                      double size, const Light& light) {
  const TextMask mask = font.draw(text, size);
  const double x = point.x + 7, y = point.y - 7 - mask.box_height;
  const bool is_inside = x >= square_.x && x + mask.box_width < square_.x + square_.width &&
                         y >= square_.y && y + mask.box_height < square_.y + square_.height;
  if (!is_inside) return;
  canvas_.stamp(mask, static_cast<int>(x) + mask.left, static_cast<int>(y) + mask.top, light);
}

void PlotPanel::axis_ticks(bool is_horizontal, const Font& font) {
  const std::size_t axis = is_horizontal ? horizontal_ : vertical_;
  const double half = 0.5 * square_.width / pixels_per_length_;
  const double low = center_.a[axis] - half, high = center_.a[axis] + half;
  const double step = tick_step(high - low);
  const double bottom = square_.y + square_.height;
  for (double n = std::ceil(low / step); n * step <= high; ++n) {
    Vec3 at = center_;
    at.a[axis] = n * step;
    const PlotPoint p = place(at);
    const TextMask mask = font.draw(fmt::format("{:.6g}", n * step + 0.0), text_size);
    if (is_horizontal) {
      line({p.x, bottom}, {p.x, bottom - 8}, 1.5, text_light);
      canvas_.stamp(mask, static_cast<int>(p.x - 0.5 * mask.box_width) + mask.left,
                    static_cast<int>(bottom + 10) + mask.top, text_light);
    } else {
      const double left = square_.x;
      line({left, p.y}, {left + 8, p.y}, 1.5, text_light);
      canvas_.stamp(mask, static_cast<int>(left - 8 - mask.box_width) + mask.left,
                    static_cast<int>(p.y - 0.5 * mask.box_height) + mask.top, text_light);
    }
  }
}

void PlotPanel::axes(const Font& font) {
  const double left = square_.x, top = square_.y;
  const double right = left + square_.width, bottom = top + square_.height;
  const PlotPoint corners[] = {{left, top}, {right, top}, {right, bottom}, {left, bottom}};
  for (int i = 0; i < 4; ++i)
    line(corners[i], corners[(i + 1) % 4], 3, frame_light);
  axis_ticks(true, font);
  axis_ticks(false, font);
  const std::string names = "xyz";
  const TextMask across = font.draw(names.substr(horizontal_, 1), 1.2 * text_size);
  canvas_.stamp(across, static_cast<int>(right - 30) + across.left,
                static_cast<int>(bottom - 14 - across.box_height) + across.top, text_light);
  const TextMask upwards = font.draw(names.substr(vertical_, 1), 1.2 * text_size);
  canvas_.stamp(upwards, static_cast<int>(left + 16) + upwards.left,
                static_cast<int>(top + 14) + upwards.top, text_light);
}

}  // namespace splotchcl
