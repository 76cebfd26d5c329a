#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "scene/constants.h"
#include "splotchcl/frame.h"

// What holds for every particle, said once for the host: which ones are bad, which ones are too
// near, what their weights mean, how many there are. Kernels have the same rules in OpenCL C.
// The reference renderer (src/reference) has a copy of its own on purpose: it is what all this is
// tested against.
namespace splotchcl {

// Where no other near limit is set, a particle nearer to the camera than this many of its own
// smoothing lengths is not drawn: its disc would cover the sky.
constexpr double near_smoothing_lengths = 0.1;

// The depth from which a particle of drawn smoothing length h is drawn. Depths are those of
// Projected: distances along the view direction or, in wide angles, from the camera.
inline double near_limit(const Frame& frame, double h) {
  const bool is_flat = frame.projection == Projection::orthographic;
  return frame.near_limit.value_or(is_flat ? 0.0 : near_smoothing_lengths * h);
}

// For estimates: what is drawn is decided by depth keys (scene/depth_key.h).
inline bool is_within_limits(const Frame& frame, double depth, double h) {
  return !(depth < near_limit(frame, h)) && !(frame.far_limit && depth > *frame.far_limit);
}

// Three coordinates.
inline bool is_finite_position(const float* position) {
  return std::isfinite(position[0]) && std::isfinite(position[1]) && std::isfinite(position[2]);
}

inline bool is_smoothing_length(float h) {
  return std::isfinite(h) && h > 0;
}

// Whether particle i is left out of every picture, and counted: a value of it that the scene
// uses is not finite, its smoothing length is not above 0, its weight or its own colour below 0.
inline bool is_bad(const Particles& particles, std::size_t i) {
  const auto is_finite = [i](const Column& column) {
    return column.is_absent() || std::isfinite(column[i]);
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(particles.position[3 * i + axis])) return true;
  }
  if (!is_smoothing_length(particles.smoothing_length[i])) return true;
  if (!is_finite(particles.weight) || particles.weight[i] < 0) return true;
  if (!particles.color_vector.is_absent()) {
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const float value = particles.color_vector[3 * i + channel];
      if (!std::isfinite(value) || value < 0) return true;
    }
  }
  return !is_finite(particles.color) || !is_finite(particles.intensity) ||
         !is_finite(particles.sort_field);
}

// w, the column of matter through a particle's center, before intensity and color: see
// WeightModel. `value` is the particle's mass or density, or with a constant weight a factor,
// sigma = kernel.width * h its width; lengths are the snapshot's.
inline double central_column(WeightModel model, double value, double h, double sigma) {
  switch (model) {
    case WeightModel::mass:
      return value / (pi * sigma * sigma);
    case WeightModel::density:
      return value * sigma * std::sqrt(pi);
    case WeightModel::constant:
      return value / h;
  }
  return 0;
}

// kernel.footprint as a width: exp(-r^2 / sigma^2) has a standard deviation of sigma / sqrt(2).
inline double footprint_sigma(const KernelSettings& kernel) {
  return std::sqrt(2.0) * kernel.footprint_pixels;
}

// The circle of confusion as a width, by how much the scale differs from that of what is in focus:
// a disc of diameter c has a variance of c^2 / 16 along each axis, and sigma^2 is twice as much.
inline double sigma_per_scale(const Lens& lens) {
  return lens.aperture / std::sqrt(8.0);
}
inline double scale_in_focus(const Frame& frame) {
  return frame.lens.aperture > 0 ? frame.camera.focal_pixels / frame.lens.focus : 0;
}
inline double lens_sigma(const Frame& frame, double pixels_per_length) {
  return sigma_per_scale(frame.lens) * std::abs(pixels_per_length - scale_in_focus(frame));
}

// What kernel.min_radius, kernel.footprint and a lens make of a cloud of a width in pixels.
struct DrawnWidth {
  double sigma = 0;   // pixels
  double column = 1;  // its central column is multiplied by this
};
inline DrawnWidth drawn_width(double sigma, const KernelSettings& kernel, double of_lens = 0) {
  const double least = std::hypot(sigma, kernel.width * kernel.min_radius_pixels);
  const double drawn = std::hypot(least, std::hypot(footprint_sigma(kernel), of_lens));
  return {drawn, sigma / drawn * (least / drawn)};
}

inline double part_per_length(double length) {
  return length > 0 ? 1 / length : 0;
}
// The part of its light that a particle at a depth keeps (Camera, DepthFade).
inline double part_after_fade(const Frame& frame, double depth) {
  const auto rising = [](double part) {
    const double u = std::min(std::max(part, 0.0), 1.0);
    return u * u * (3 - 2 * u);
  };
  const DepthFade& fade = frame.fade;
  double part = 1;
  if (fade.near_length > 0)
    part *= rising((depth - frame.near_limit.value_or(0)) / fade.near_length);
  if (fade.far_length > 0 && frame.far_limit)
    part *= rising((*frame.far_limit - depth) / fade.far_length);
  return part;
}

// A power of two near 1 / the look-at distance: lengths times it keep sigma^2 inside single
// precision, whatever the snapshot's unit.
inline double length_scale(const Frame& frame) {
  return std::exp2(-std::round(std::log2(frame.camera.look_at_distance)));
}

// The factor a on a particle's mass, density or 1 that gives w / reference_column (see
// central_column) from scaled lengths s = length_scale * sigma, t = length_scale * h without
// leaving single precision on the way:
//   mass m: m (a / s) (a / s)      density rho: rho a s      constant: a / t
inline double weight_scale(const DrawnComponent& component, double length_scale) {
  switch (component.weight) {
    case WeightModel::mass:
      return length_scale / std::sqrt(pi * component.reference_column);
    case WeightModel::density:
      return std::sqrt(pi) / (length_scale * component.reference_column);
    case WeightModel::constant:
      return length_scale / component.reference_column;
  }
  return 0;
}

}  // namespace splotchcl
