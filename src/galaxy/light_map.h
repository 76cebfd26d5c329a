#pragma once

#include <optional>

#include "galaxy/disk_plane.h"
#include "galaxy/dust_map.h"
#include "galaxy/light.h"
#include "galaxy/sky.h"
#include "splotchcl/galaxy.h"

namespace splotchcl {

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
  void fade(const GalaxySettings& settings);
  void take_dust_away(const GalaxySettings& settings);
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

}  // namespace splotchcl
