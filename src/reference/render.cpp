#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <future>
#include <thread>
#include <vector>

#include "parallel/ordered_tasks.h"
#include "scene/projection.h"
#include "splotchcl/reference.h"

namespace splotchcl::reference {
namespace {

// The mean of exp(-(t - centre)^2 / sigma^2) for t from i to i + 1: one axis of a pixel's
// mean, since the Gaussian and the pixel are both products of their axes.
double mean_over_pixel(double center, double sigma, int i) {
  constexpr double half_sqrt_pi = 0.886226925452758014;
  const double low = (i - center) / sigma;
  const double high = (i + 1 - center) / sigma;
  // Both ends on one side: erf is close to +-1 there and its differences lose the digits
  // that erfc keeps.
  if (low > 0) return half_sqrt_pi * sigma * (std::erfc(low) - std::erfc(high));
  if (high < 0) return half_sqrt_pi * sigma * (std::erfc(-high) - std::erfc(-low));
  return half_sqrt_pi * sigma * (std::erf(high) - std::erf(low));
}

double value_at_pixel_center(double center, double sigma, int i) {
  const double distance = (i + 0.5 - center) / sigma;
  return std::exp(-distance * distance);
}

// One axis of the shape in pixel i; the shape is the product of its two axes where the
// kernel does not cut it.
double axis_profile(double center, double sigma, int i, Sampling sampling) {
  return sampling == Sampling::mean ? mean_over_pixel(center, sigma, i)
                                    : value_at_pixel_center(center, sigma, i);
}

// The shape of a splat on a face of a cube in pixel (x, y): peak * exp(-squared).
struct FaceShape {
  double peak = 0, squared = 0;
};

FaceShape shape_on_face(const Splat& splat, int x, int y) {
  const Splat::OnFace& face = splat.on_face;
  const double dx = x + 0.5 - splat.x, dy = y + 0.5 - splat.y;
  const double across = (x + 0.5 - face.middle_x) / face.focal_pixels;
  const double along = (y + 0.5 - face.middle_y) / face.focal_pixels;
  const double k = 1 + across * across + along * along, g = face.squared_width;
  const double m = g * k + face.footprint, turned = across * dy - along * dx;
  FaceShape shape;
  shape.peak = g * k / m;
  shape.squared = (dx * dx + dy * dy + turned * turned) / (m * face.secant2);
  return shape;
}

// Whether kernel.cut takes the splat's light from the pixel: its centre is farther than
// cut * sigma. With pixel means the pixel that holds the splat's centre keeps its light
// however small the splat is, or all clouds far below a pixel would vanish.
bool is_cut(const Splat& splat, int x, int y, const KernelSettings& kernel) {
  if (!kernel.cut) return false;
  if (splat.on_face.focal_pixels > 0)
    return shape_on_face(splat, x, y).squared > *kernel.cut * *kernel.cut;
  const double dx = (x + 0.5 - splat.x) / splat.stretch;
  const double dy = y + 0.5 - splat.y;
  const double radius = *kernel.cut * splat.sigma;
  if (dx * dx + dy * dy <= radius * radius) return false;
  const bool holds_center = std::floor(splat.x) == x && std::floor(splat.y) == y;
  return !(kernel.sampling == Sampling::mean && holds_center);
}

}  // namespace

void sort(std::vector<Splat>& splats, const SortOrder& order) {
  if (order.descending) {
    std::stable_sort(splats.begin(), splats.end(), [](const Splat& a, const Splat& b) {
      return a.key != b.key ? a.key > b.key : !a.is_around && b.is_around;
    });
  } else {
    std::stable_sort(splats.begin(), splats.end(), [](const Splat& a, const Splat& b) {
      return a.key != b.key ? a.key < b.key : !a.is_around && b.is_around;
    });
  }
}

namespace {

// phi(y) = (1 - exp(-y)) / y. The series' next term, y^3 / 24, is below 1e-13 there.
double phi(double y) {
  if (y < 1e-4) return 1 - y / 2 + y * y / 6;
  return -std::expm1(-y) / y;
}

// The layer of a column X of one splat: tau = A X, S = E X phi(tau).
Layer layer_of(const Splat& splat, double column) {
  Layer layer;
  for (int c = 0; c < 3; ++c) {
    layer.optical_depth[c] = splat.absorption[c] * column;
    layer.source[c] = splat.emission[c] * column * phi(layer.optical_depth[c]);
  }
  return layer;
}

}  // namespace

double ray_shape(const Vec3& center, const Vec3& direction) {
  double t = 0, distance2 = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    t += center.a[axis] * direction.a[axis];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double beside = center.a[axis] - t * direction.a[axis];
    distance2 += beside * beside;
  }
  return std::exp(-distance2) * std::erfc(-t) / 2;
}

double shape(const Splat& splat, int x, int y, const KernelSettings& kernel) {
  if (is_cut(splat, x, y, kernel)) return 0;
  if (splat.on_face.focal_pixels > 0) {
    const FaceShape on_face = shape_on_face(splat, x, y);
    return on_face.peak * std::exp(-on_face.squared);
  }
  return axis_profile(splat.x, splat.stretch * splat.sigma, x, kernel.sampling) *
         axis_profile(splat.y, splat.sigma, y, kernel.sampling);
}

Layer over(const Layer& near_layer, const Layer& far_layer) {
  Layer both;
  for (int c = 0; c < 3; ++c) {
    both.optical_depth[c] = near_layer.optical_depth[c] + far_layer.optical_depth[c];
    both.source[c] =
        near_layer.source[c] + std::exp(-near_layer.optical_depth[c]) * far_layer.source[c];
  }
  return both;
}

namespace {

// X per unit weight of a splat that may be of a cloud around the camera, in a pixel that looks in
// this direction.
double shape_around(const Splat& splat, int x, int y, const Vec3& direction,
                    const KernelSettings& kernel) {
  double column = splat.splat_part > 0 ? splat.splat_part * shape(splat, x, y, kernel) : 0;
  if (splat.ray_part > 0) column += splat.ray_part * ray_shape(splat.center, direction);
  return column;
}

}  // namespace

Layer composite_pixel(const std::vector<Splat>& splats, int x, int y, const Frame& frame) {
  const Vec3 direction = frame.projection == Projection::orthographic
                             ? Vec3{}
                             : direction_at(x + 0.5, y + 0.5, frame.camera, frame.projection);
  Layer pixel;
  for (const Splat& splat : splats) {
    const double column = splat.weight * shape_around(splat, x, y, direction, frame.kernel);
    if (column > 0) pixel = over(pixel, layer_of(splat, column));
  }
  return pixel;
}

namespace {

// Pixels first <= i < end of one axis.
struct Range {
  int first, end;
};

// Beyond this distance from its centre a splat adds less than 1e-14 to any pixel: far
// below what the other terms of a pixel's sum lose in double precision. One pixel
// more is for means: their pixels reach closer to the splat than their centres do.
double reach_in_sigmas(const Splat& splat) {
  double strongest = 1;
  for (int c = 0; c < 3; ++c) {
    strongest =
        std::max({strongest, splat.weight * splat.emission[c], splat.weight * splat.absorption[c]});
  }
  return std::sqrt(std::log(1e14) + std::log(strongest));
}

Range pixels_within(double center, double radius, int first, int end) {
  // Clamped before the conversion: a splat close to the camera may lie anywhere.
  const double low = std::clamp<double>(std::floor(center - radius), first, end);
  const double high = std::clamp<double>(std::ceil(center + radius), first, end);
  return {static_cast<int>(low), static_cast<int>(high)};
}

// Draws a part of the rows of the picture, all splats in order.
class RowPainter {
 public:
  RowPainter(const Frame& frame, int first_row, int row_step)
      : frame_(frame), first_row_(first_row), row_step_(row_step) {}

  void add(const Splat& splat, std::vector<Layer>& layers) {
    const Rectangle& crop = frame_.crop;
    if (splat.is_around) {
      add_around(splat, layers);
      return;
    }
    if (splat.on_face.focal_pixels > 0) {
      add_on_face(splat, layers);
      return;
    }
    const double radius = splat.sigma * reach_in_sigmas(splat) + 1;
    const double radius_x = splat.stretch * (radius - 1) + 1;
    const Range columns = pixels_within(splat.x, radius_x, crop.x, crop.x + crop.width);
    const Range rows = pixels_within(splat.y, radius, crop.y, crop.y + crop.height);
    if (columns.first >= columns.end || rows.first >= rows.end) return;

    const Sampling sampling = frame_.kernel.sampling;
    profile_x_.clear();
    for (int x = columns.first; x < columns.end; ++x) {
      profile_x_.push_back(splat.weight *
                           axis_profile(splat.x, splat.stretch * splat.sigma, x, sampling));
    }
    for (int y = own_row_from(rows.first); y < rows.end; y += row_step_) {
      // The row's part of an ellipse; a pixel more, since dy is to the pixel's centre.
      const double dy = std::min(std::abs(y + 0.5 - splat.y) / radius, 1.0);
      const Range row_columns =
          pixels_within(splat.x, radius_x * std::sqrt(1 - dy * dy) + 1, columns.first, columns.end);
      const double profile_y = axis_profile(splat.y, splat.sigma, y, sampling);
      Layer* row = layers.data() +
                   static_cast<std::size_t>(y - crop.y) * static_cast<std::size_t>(crop.width);
      for (int x = row_columns.first; x < row_columns.end; ++x) {
        const double column = profile_x_[static_cast<std::size_t>(x - columns.first)] * profile_y;
        if (!(column > 0) || is_cut(splat, x, y, frame_.kernel)) continue;
        Layer& pixel = row[x - crop.x];
        pixel = over(pixel, layer_of(splat, column));
      }
    }
  }

 private:
  // A cloud around the camera may be seen anywhere.
  void add_around(const Splat& splat, std::vector<Layer>& layers) {
    if (directions_.empty()) find_directions();
    const Rectangle& crop = frame_.crop;
    const Vec3* direction = directions_.data();
    const double reach = reach_in_sigmas(splat), nothing = std::exp(-reach * reach);
    for (int y = own_row_from(crop.y); y < crop.y + crop.height; y += row_step_) {
      Layer* row = layers.data() +
                   static_cast<std::size_t>(y - crop.y) * static_cast<std::size_t>(crop.width);
      for (int x = crop.x; x < crop.x + crop.width; ++x) {
        const double column = shape_around(splat, x, y, *direction++, frame_.kernel);
        if (column < nothing) continue;
        Layer& pixel = row[x - crop.x];
        pixel = over(pixel, layer_of(splat, splat.weight * column));
      }
    }
  }

  // Of a cube. No pixel's secant is more than that of the corners, and no splat's less than 1:
  // where nothing of it is left at `reach` widths, nothing is left at that times the corners'
  // secant.
  void add_on_face(const Splat& splat, std::vector<Layer>& layers) {
    constexpr double secant_of_corners = 1.7320508075688772;
    const Rectangle& crop = frame_.crop;
    const double reach = reach_in_sigmas(splat), radius = splat.sigma * reach * secant_of_corners;
    const Range columns =
        pixels_within(splat.x, splat.stretch * radius + 1, crop.x, crop.x + crop.width);
    const Range rows = pixels_within(splat.y, radius + 1, crop.y, crop.y + crop.height);
    for (int y = own_row_from(rows.first); y < rows.end; y += row_step_) {
      Layer* row = layers.data() +
                   static_cast<std::size_t>(y - crop.y) * static_cast<std::size_t>(crop.width);
      for (int x = columns.first; x < columns.end; ++x) {
        const double column = splat.weight * shape(splat, x, y, frame_.kernel);
        if (!(column > 0)) continue;
        Layer& pixel = row[x - crop.x];
        pixel = over(pixel, layer_of(splat, column));
      }
    }
  }

  // Of the pixels of its own rows.
  void find_directions() {
    const Rectangle& crop = frame_.crop;
    for (int y = own_row_from(crop.y); y < crop.y + crop.height; y += row_step_) {
      for (int x = crop.x; x < crop.x + crop.width; ++x)
        directions_.push_back(direction_at(x + 0.5, y + 0.5, frame_.camera, frame_.projection));
    }
  }

  // The first of this painter's rows at or after y.
  int own_row_from(int y) const {
    const int behind = (y - frame_.crop.y - first_row_) % row_step_;
    return y + (row_step_ - behind) % row_step_;
  }

  const Frame& frame_;
  int first_row_, row_step_;
  std::vector<double> profile_x_;
  std::vector<Vec3> directions_;  // where clouds are around the camera
};

// Every thread walks through all splats and draws its own rows, so the result does not
// depend on their number. Rows take turns, which shares out a bright centre.
std::vector<Layer> composite(const std::vector<Splat>& splats, const Frame& frame,
                             const std::function<void(double)>& progress) {
  std::vector<Layer> layers(static_cast<std::size_t>(frame.crop.width) *
                            static_cast<std::size_t>(frame.crop.height));
  const int thread_count = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  std::atomic<bool> has_failed = false;  // what one thread throws ends all
  const auto draw_rows = [&](int thread) {
    RowPainter painter(frame, thread, thread_count);
    const std::size_t report_every = std::max<std::size_t>(1, splats.size() / 100);
    for (std::size_t i = 0; i < splats.size() && !has_failed; ++i) {
      painter.add(splats[i], layers);
      if (thread == 0 && progress && i % report_every == 0) {
        progress(static_cast<double>(i) / static_cast<double>(splats.size()));
      }
    }
  };
  const auto draw_or_fail = [&](int thread) {
    try {
      draw_rows(thread);
    } catch (...) {
      has_failed = true;
      throw;
    }
  };
  // Futures carry an exception of any thread here, after all have ended.
  std::vector<std::future<void>> others;
  for (int t = 1; t < thread_count; ++t) {
    others.push_back(in_background([&draw_or_fail, t] { draw_or_fail(t); }));
  }
  draw_or_fail(0);
  for (std::future<void>& other : others)
    other.get();
  return layers;
}

// What stands behind pixel i of the crop.
std::array<double, 3> background_of(std::size_t i, const Frame& frame) {
  if (!frame.background_image) return frame.background;
  const int x = static_cast<int>(i % static_cast<std::size_t>(frame.crop.width));
  const int y = static_cast<int>(i / static_cast<std::size_t>(frame.crop.width));
  const float* pixel = frame.background_image->at(frame.crop.x + x, frame.crop.y + y);
  return {static_cast<double>(pixel[0]), static_cast<double>(pixel[1]),
          static_cast<double>(pixel[2])};
}

// Whether the pixel shows any direction at all: not outside the circle of a fisheye picture.
// In half pixels, which are whole numbers.
bool is_in_picture(std::size_t i, const Frame& frame) {
  if (frame.projection != Projection::fisheye) return true;
  const auto width = static_cast<std::size_t>(frame.crop.width);
  const auto x = static_cast<std::int64_t>(i % width) + frame.crop.x;
  const auto y = static_cast<std::int64_t>(i / width) + frame.crop.y;
  const std::int64_t across = 2 * x + 1 - frame.width, along = 2 * y + 1 - frame.height;
  const std::int64_t diameter = std::min(frame.width, frame.height);
  return across * across + along * along <= diameter * diameter;
}

ReferenceImage resolve(const std::vector<Layer>& layers, const Frame& frame) {
  ReferenceImage image(frame.crop.width, frame.crop.height);
  for (std::size_t i = 0; i < layers.size(); ++i) {
    if (!is_in_picture(i, frame)) continue;
    const std::array<double, 3> background = background_of(i, frame);
    double opacity = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double depth = layers[i].optical_depth[c];
      image.pixels[4 * i + c] = layers[i].source[c] + std::exp(-depth) * background[c];
      opacity += -std::expm1(-depth) / 3;
    }
    image.pixels[4 * i + 3] = opacity;
  }
  return image;
}

}  // namespace

// Composited in depth order even where the plan needs no order: that is how the plans'
// shortcuts are checked.
ReferenceImage render(const Frame& frame, const std::function<void(double)>& progress) {
  std::vector<Splat> splats = project(frame);
  sort(splats, frame.sort);
  const std::vector<Layer> layers = composite(splats, frame, progress);
  if (progress) progress(1);
  return resolve(layers, frame);
}

}  // namespace splotchcl::reference
