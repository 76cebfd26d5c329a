#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "galaxy/dust_map.h"
#include "galaxy/light.h"
#include "scene/constants.h"
#include "splotchcl/galaxy.h"
#include "splotchcl/image.h"

namespace splotchcl {

// What a picture shows where there is no galaxy.
struct Sky {
  Light level = {0, 0, 0};
  double noise = 0;  // standard deviation of a pixel's mean over the channels
};

// From the picture's border: the median of each channel, and the median distance from it.
Sky measure_sky(const Image& picture);

// The same picture with the sky's light taken away, none below 0.
Image without_sky(const Image& picture, const Sky& sky);

struct StarCriteria {
  double contrast = 2.5;   // of a star against the median around it
  double least_light = 0;  // above that median
  int center_x = 0, center_y = 0;
  double protected_radius = 0;  // around the centre: a galaxy's nucleus is a point, too
};

// Replaces points of light by the median of what surrounds them: pixels far brighter than the
// median of a ring around them, unless both red and blue exceed green, as in the clouds that
// shine in hydrogen's red line among young stars. Returns how many pixels were replaced.
std::uint64_t remove_foreground_stars(Image& picture, const StarCriteria& criteria);

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

// The galaxy's own light at each point of its disk: a picture without sky, foreground stars,
// border and dust.
class LightMap {
 public:
  // Throws DataError for a picture without a galaxy.
  LightMap(const Image& picture, const GalaxySettings& settings, double file_pixels);

  const Image& picture() const { return picture_; }
  const DustMap& dust() const { return *dust_; }
  const DiskPlane& plane() const { return plane_; }
  double radius() const { return radius_; }                    // kpc; no light lies beyond
  double threshold() const { return threshold_; }              // of a pixel's mean light
  const Light& center_color() const { return center_color_; }  // mean within the bulge
  double total_light() const;  // summed over the disk's area, mean of the channels
  // None outside the picture.
  Light at(const DiskPlane::Point& disk) const;

  // What make_galaxy tells of it.
  Sky sky() const { return sky_; }
  std::uint64_t pixels_of_stars() const { return pixels_of_stars_; }
  DiskPlane::Point center() const { return center_; }

 private:
  void darken_noise();
  // How much of the galaxy is kept of each pixel, towards the picture's border and its own radius.
  std::vector<double> kept_of_pixels(const GalaxySettings& settings) const;
  void take_dust_away(const GalaxySettings& settings, const std::vector<double>& kept);
  void multiply(const std::vector<double>& factors);
  Light mean_light_within(double radius) const;

  Sky sky_;
  Image picture_;
  DiskPlane::Point center_;
  std::uint64_t pixels_of_stars_ = 0;
  DiskPlane plane_;
  double radius_ = 0;
  double threshold_ = 0;
  std::optional<DustMap> dust_;
  Light center_color_ = {0, 0, 0};
};

// The light of a transparent Plummer sphere along the line of sight: what the disk leaves to the
// bulge.
class BulgeProfile {
 public:
  BulgeProfile(const LightMap& map, const GalaxySettings& settings)
      : radius_(settings.bulge_radius_kpc),
        peak_((settings.bulge_stars > 0 ? settings.bulge_light : 0.0) * map.center_color()) {}

  Light column(double radius) const {
    return std::pow(1 + radius * radius / (radius_ * radius_), -2) * peak_;
  }
  // What remains of the picture's light for the disk.
  Light rest(const Light& light, double radius) const {
    const Light taken = column(radius);
    Light rest;
    for (std::size_t i = 0; i < 3; ++i)
      rest[i] = std::max(0.0, light[i] - taken[i]);
    return rest;
  }
  const Light& peak() const { return peak_; }
  // Of the face-on area that would have all of the bulge's light at the peak's brightness.
  double area() const { return pi * radius_ * radius_; }

 private:
  double radius_;
  Light peak_;
};

}  // namespace splotchcl
