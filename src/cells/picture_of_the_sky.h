#pragma once

#include "cells/sky_grid.h"

namespace splotchcl {

// Square pixels in a plane that the sky is shown on, the middle at [longitude, latitude];
// longitudes grow to the left. Angles are in degrees. Beyond the edge of the sky pixels have no
// solid angle.
class PictureOfTheSky : public SkyGrid {
 public:
  // TAN: a plane that touches the sky, as a lens shows it. CAR: longitude and latitude themselves.
  enum class Projection { tan, car };

  // `pixel` is its side where the plane touches the sky, or a degree of longitude at the equator.
  PictureOfTheSky(Projection projection, int width, int height, double longitude, double latitude,
                  double pixel);

  std::size_t cells() const override;
  std::vector<SkyPatch> faces() const override;
  // Row 0 of cells is at the top; y of patches grows downwards.
  std::size_t cell(int face, int x, int y) const override;
  double solid_angle(std::size_t cell) const override;
  bool has_all_of_the_sky() const override;
  std::optional<std::size_t> cell_at(const Vec3& direction) const override;
  Vec3 direction(int face, double x, double y) const override;
  double density(int face, double x, double y) const override;
  double radius(const SkyPatch& patch) const override;
  double longest_side(const SkyPatch& patch) const override;
  bool is_bent(const SkyPatch& patch) const override;

 private:
  double latitude_at(double y) const;

  Projection projection_;
  int width_, height_;
  double longitude_, latitude_, pixel_;  // radians
  Vec3 middle_, left_, up_;
};

}  // namespace splotchcl
