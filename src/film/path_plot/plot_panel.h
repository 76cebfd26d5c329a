#pragma once

#include <string>

#include "finish/overlay.h"
#include "image/text.h"
#include "splotchcl/vector.h"

namespace splotchcl {

// Of what is written on the plot.
constexpr Light text_light = {0.75F, 0.75F, 0.75F};

struct PlotPoint {
  double x = 0, y = 0;  // in pixels, y downwards
};

// A square of the plot that shows two axes of space, and draws in it, anti-aliased. What lies
// outside is left out.
class PlotPanel {
 public:
  // `horizontal` and `vertical` are axes from 0 to 2; `center` is in the square's middle.
  PlotPanel(Image& image, const Rectangle& square, std::size_t horizontal, std::size_t vertical,
            const Vec3& center, double pixels_per_length);

  PlotPoint place(const Vec3& position) const;
  PlotPoint corner() const;  // top left
  double pixels_per_length() const { return pixels_per_length_; }

  void line(const PlotPoint& from, const PlotPoint& to, double width, const Light& light,
            float opacity = 1);
  void disc(const PlotPoint& center, double radius, const Light& light);
  void ring(const PlotPoint& center, double radius, double width, const Light& light);
  // An arrow with its head at `to`.
  void arrow(const PlotPoint& from, const PlotPoint& to, double width, const Light& light);
  // Adds light to the pixel.
  void add_light(const PlotPoint& point, const Light& light);
  // Right of the point and above it.
  void label(const PlotPoint& point, const std::string& text, const Font& font, double size,
             const Light& light);
  // Frame, ticks with numbers, and names of the axes.
  void axes(const Font& font);

 private:
  template <class Distance>
  void shape(const PlotPoint& low, const PlotPoint& high, double half_width, const Light& light,
             float opacity, Distance distance);
  void axis_ticks(bool is_horizontal, const Font& font);

  Image& image_;
  Canvas canvas_;
  Rectangle square_;
  std::size_t horizontal_, vertical_;
  Vec3 center_;
  double pixels_per_length_;
};

}  // namespace splotchcl
