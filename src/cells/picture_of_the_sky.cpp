#include "cells/picture_of_the_sky.h"

#include <algorithm>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>

#include "scene/constants.h"

namespace splotchcl {
namespace {

using namespace boost::qvm;

Vec3 direction_to(double longitude, double latitude) {
  return {{std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
           std::sin(latitude)}};
}

}  // namespace

PictureOfTheSky::PictureOfTheSky(Projection projection, int width, int height, double longitude,
                                 double latitude, double pixel)
    : projection_(projection),
      width_(width),
      height_(height),
      longitude_(longitude * pi / 180),
      latitude_(latitude * pi / 180),
      pixel_(pixel * pi / 180),
      middle_(direction_to(longitude_, latitude_)),
      left_({{-std::sin(longitude_), std::cos(longitude_), 0}}),
      up_(cross(middle_, left_)) {}

std::size_t PictureOfTheSky::cells() const {
  return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
}

std::vector<SkyPatch> PictureOfTheSky::faces() const {
  return {{0, 0, 0, static_cast<double>(width_), static_cast<double>(height_)}};
}

std::size_t PictureOfTheSky::cell(int /*face*/, int x, int y) const {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
         static_cast<std::size_t>(x);
}

bool PictureOfTheSky::has_all_of_the_sky() const {
  constexpr double rounding = 1e-9;
  return projection_ == Projection::car && std::abs(width_ * pixel_ - 2 * pi) < rounding &&
         latitude_at(0) >= 0.5 * pi - rounding && latitude_at(height_) <= -0.5 * pi + rounding;
}

double PictureOfTheSky::latitude_at(double y) const {
  return latitude_ + (0.5 * height_ - y) * pixel_;
}

Vec3 PictureOfTheSky::direction(int /*face*/, double x, double y) const {
  const double left = (0.5 * width_ - x) * pixel_, up = (0.5 * height_ - y) * pixel_;
  if (projection_ == Projection::car)
    return direction_to(longitude_ + left, std::clamp(latitude_ + up, -0.5 * pi, 0.5 * pi));
  return normalized(middle_ + left * left_ + up * up_);
}

double PictureOfTheSky::density(int /*face*/, double x, double y) const {
  if (projection_ == Projection::car) {
    const double latitude = latitude_at(y);
    return std::abs(latitude) < 0.5 * pi ? pixel_ * pixel_ * std::cos(latitude) : 0;
  }
  const double left = (0.5 * width_ - x) * pixel_, up = (0.5 * height_ - y) * pixel_;
  return pixel_ * pixel_ / std::pow(1 + left * left + up * up, 1.5);
}

// Of a plane: a quarter of the sum over the signs of the corners (a rectangle's solid angle).
double PictureOfTheSky::solid_angle(std::size_t cell) const {
  const std::size_t row = cell / static_cast<std::size_t>(width_);
  const auto y = static_cast<double>(row);
  const auto x = static_cast<double>(cell - row * static_cast<std::size_t>(width_));
  if (projection_ == Projection::car) {
    const auto height = [](double latitude) {
      return std::sin(std::clamp(latitude, -0.5 * pi, 0.5 * pi));
    };
    return pixel_ * (height(latitude_at(y)) - height(latitude_at(y + 1)));
  }
  // Small pixels would be differences of large numbers: by two by two points instead.
  constexpr double low = 0.21132486540518711775;
  double sum = 0;
  for (const double dx : {low, 1 - low}) {
    for (const double dy : {low, 1 - low})
      sum += 0.25 * density(0, x + dx, y + dy);
  }
  return sum;
}

double PictureOfTheSky::radius(const SkyPatch& patch) const {
  return std::min(pi, 0.5 * pixel_ * std::hypot(patch.width, patch.height) * 1.0000001);
}

// Near a pole the other one is far shorter.
double PictureOfTheSky::longest_side(const SkyPatch& patch) const {
  return pixel_ * std::max(patch.width, patch.height);
}

bool PictureOfTheSky::is_bent(const SkyPatch& /*patch*/) const {
  return false;
}

std::optional<std::size_t> PictureOfTheSky::cell_at(const Vec3& direction) const {
  double left = 0, up = 0;
  if (projection_ == Projection::car) {
    left = std::remainder(std::atan2(direction.a[1], direction.a[0]) - longitude_, 2 * pi);
    up = std::asin(std::clamp(direction.a[2], -1.0, 1.0)) - latitude_;
  } else {
    const double along = dot(direction, middle_);
    if (!(along > 0)) return std::nullopt;
    left = dot(direction, left_) / along;
    up = dot(direction, up_) / along;
  }
  const double x = 0.5 * width_ - left / pixel_, y = 0.5 * height_ - up / pixel_;
  if (!(x >= 0 && y >= 0 && x < width_ && y < height_)) return std::nullopt;
  return cell(0, static_cast<int>(x), static_cast<int>(y));
}

}  // namespace splotchcl
