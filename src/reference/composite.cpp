#include <algorithm>
#include <cmath>

#include "reference/profile.h"
#include "scene/projection.h"
#include "splotchcl/reference.h"

namespace splotchcl::reference {

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

Layer layer_of(const Splat& splat, double column) {
  Layer layer;
  for (int c = 0; c < 3; ++c) {
    layer.optical_depth[c] = splat.absorption[c] * column;
    layer.source[c] = splat.emission[c] * column * phi(layer.optical_depth[c]);
  }
  return layer;
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

double shape_around(const Splat& splat, int x, int y, const Vec3& direction,
                    const KernelSettings& kernel) {
  double column = splat.splat_part > 0 ? splat.splat_part * shape(splat, x, y, kernel) : 0;
  if (splat.ray_part > 0) column += splat.ray_part * ray_shape(splat.center, direction);
  return column;
}

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

}  // namespace splotchcl::reference
