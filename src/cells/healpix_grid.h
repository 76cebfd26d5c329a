#pragma once

#include <vector>

#include "cells/sky_grid.h"
#include "splotchcl/map_settings.h"

namespace splotchcl {

// The largest NSIDE, of 805306368 pixels.
constexpr int most_healpix_sides = 8192;

bool is_healpix_side(int nside);  // a power of two up to that

// The pixels of equal area of Gorski et al. 2005 (ApJ 622, 759): twelve faces of NSIDE x NSIDE.
class HealpixGrid : public SkyGrid {
 public:
  HealpixGrid(int nside, HealpixOrder order);

  std::size_t cells() const override;
  std::vector<SkyPatch> faces() const override;
  std::size_t cell(int face, int x, int y) const override;
  double solid_angle(std::size_t cell) const override;
  bool has_all_of_the_sky() const override { return true; }
  std::optional<std::size_t> cell_at(const Vec3& direction) const override;
  Vec3 direction(int face, double x, double y) const override;
  double density(int face, double x, double y) const override;
  double radius(const SkyPatch& patch) const override;
  double longest_side(const SkyPatch& patch) const override;
  bool is_bent(const SkyPatch& patch) const override;

 private:
  std::size_t ring_number(int face, int x, int y) const;

  int nside_;
  HealpixOrder order_;
  std::vector<double> radius_;  // of a face, of a quarter of it, ...
};

}  // namespace splotchcl
