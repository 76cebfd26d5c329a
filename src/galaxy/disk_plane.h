#pragma once

#include <array>
#include <cmath>

#include "scene/constants.h"

namespace splotchcl {

// Maps between a picture's pixels and the plane of the galaxy's disk, which the picture shows
// inclined.
class DiskPlane {
 public:
  using Point = std::array<double, 2>;  // of the picture in pixels, or of the disk in lengths

  // The position angle is that of the line along which the disk is not foreshortened, from
  // up, counter-clockwise.
  DiskPlane(const Point& center_pixel, double inclination_degrees, double position_angle_degrees,
            double pixel_size)
      : center_(center_pixel), pixel_size_(pixel_size) {
    constexpr double radians = pi / 180;
    const double angle = position_angle_degrees * radians;
    major_ = {-std::sin(angle), std::cos(angle)};
    foreshortening_ = std::cos(inclination_degrees * radians);
  }

  // In the disk, from its centre: right and up as in the picture, in length units.
  Point in_disk(const Point& pixel) const {
    return stretched({pixel_size_ * (pixel[0] - center_[0]), pixel_size_ * (center_[1] - pixel[1])},
                     1 / foreshortening_);
  }
  Point in_picture(const Point& disk) const {
    const Point seen = stretched(disk, foreshortening_);
    return {center_[0] + seen[0] / pixel_size_, center_[1] - seen[1] / pixel_size_};
  }
  // Of the disk, in squared length units.
  double area_of_pixel() const { return pixel_size_ * pixel_size_ / foreshortening_; }
  double pixel_size() const { return pixel_size_; }

 private:
  // Across the major axis alone.
  Point stretched(const Point& point, double factor) const {
    const double along = point[0] * major_[0] + point[1] * major_[1];
    const Point across = {point[0] - along * major_[0], point[1] - along * major_[1]};
    return {along * major_[0] + factor * across[0], along * major_[1] + factor * across[1]};
  }

  Point center_, major_;
  double foreshortening_, pixel_size_;
};

}  // namespace splotchcl
