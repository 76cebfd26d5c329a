#pragma once

#include <array>
#include <cmath>

#include "scene/constants.h"

namespace splotchcl {

// Between a picture's pixels and the plane of the galaxy's disk that it shows inclined.
class DiskPlane {
 public:
  using Place = std::array<double, 2>;

  // The position angle is that of the line along which the disk is not foreshortened, from
  // up, counter-clockwise.
  DiskPlane(const Place& center_pixel, double inclination_degrees, double position_angle_degrees,
            double pixel_size)
      : center_(center_pixel), pixel_size_(pixel_size) {
    constexpr double radians = pi / 180;
    const double angle = position_angle_degrees * radians;
    major_ = {-std::sin(angle), std::cos(angle)};
    foreshortening_ = std::cos(inclination_degrees * radians);
  }

  // In the disk, from its centre: right and up as in the picture, in length units.
  Place in_disk(const Place& pixel) const {
    return stretched({pixel_size_ * (pixel[0] - center_[0]), pixel_size_ * (center_[1] - pixel[1])},
                     1 / foreshortening_);
  }
  Place in_picture(const Place& disk) const {
    const Place seen = stretched(disk, foreshortening_);
    return {center_[0] + seen[0] / pixel_size_, center_[1] - seen[1] / pixel_size_};
  }
  // Of the disk, in squared length units.
  double area_of_pixel() const { return pixel_size_ * pixel_size_ / foreshortening_; }
  double pixel_size() const { return pixel_size_; }

 private:
  // Across the major axis alone.
  Place stretched(const Place& place, double factor) const {
    const double along = place[0] * major_[0] + place[1] * major_[1];
    const Place across = {place[0] - along * major_[0], place[1] - along * major_[1]};
    return {along * major_[0] + factor * across[0], along * major_[1] + factor * across[1]};
  }

  Place center_, major_;
  double foreshortening_, pixel_size_;
};

}  // namespace splotchcl
