#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "splotchcl/map_settings.h"
#include "splotchcl/vector.h"

namespace splotchcl {

// A rectangle on a face of a grid, in cells.
struct SkyPatch {
  int face = 0;
  double x = 0, y = 0, width = 0, height = 0;
};

// Cells that the sky is divided into: the squares of a few faces.
class SkyGrid {
 public:
  SkyGrid() = default;
  virtual ~SkyGrid() = default;
  SkyGrid(const SkyGrid&) = delete;
  SkyGrid& operator=(const SkyGrid&) = delete;

  virtual std::size_t cells() const = 0;
  // The whole faces.
  virtual std::vector<SkyPatch> faces() const = 0;
  // The number of the cell with this lower left corner.
  virtual std::size_t cell(int face, int x, int y) const = 0;
  virtual double solid_angle(std::size_t cell) const = 0;
  virtual bool has_all_of_the_sky() const = 0;
  // The cell that a direction lies in; none: beyond its edges.
  virtual std::optional<std::size_t> cell_at(const Vec3& direction) const = 0;

  // A unit vector; x and y are coordinates on a face.
  virtual Vec3 direction(int face, double x, double y) const = 0;
  // At a place on a face, of a square as large as a cell.
  virtual double density(int face, double x, double y) const = 0;
  // The angle from the direction of a patch's middle within which all of it lies.
  virtual double radius(const SkyPatch& patch) const = 0;
  // An angle that no side of a patch is longer than, where it is small.
  virtual double longest_side(const SkyPatch& patch) const = 0;
  // Whether directions are not smooth: they have a bend along the diagonal from (x + width, y) to
  // (x, y + height), or run together in a corner.
  virtual bool is_bent(const SkyPatch& patch) const = 0;
};

// Points of Gauss and Legendre along an axis from 0 to 1, exact to the order 2 `count` - 1; errors
// are the next even derivative over `divisor`, times the side of a patch to that power.
struct SkyRule {
  int count;
  double divisor;
  std::array<double, 4> places, weights;
};

constexpr std::array<SkyRule, 3> sky_rules = {{
    {1, 24, {0.5}, {1}},
    {2, 4320, {0.2113248654051871, 0.7886751345948129}, {0.5, 0.5}},
    {4,
     1778112000,
     {0.0694318442029737, 0.3300094782075719, 0.6699905217924281, 0.9305681557970263},
     {0.1739274225687269, 0.3260725774312731, 0.3260725774312731, 0.1739274225687269}},
}};

// Calls visit(direction, weight) for points whose values, times their weights, add up to the
// integral over a patch, in cells.
template <typename Visit>
void visit_square(const SkyGrid& grid, const SkyPatch& patch, const SkyRule& rule, Visit&& visit) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(rule.count); ++i) {
    for (std::size_t j = 0; j < static_cast<std::size_t>(rule.count); ++j) {
      const double x = patch.x + patch.width * rule.places[i],
                   y = patch.y + patch.height * rule.places[j];
      visit(grid.direction(patch.face, x, y), patch.width * patch.height * rule.weights[i] *
                                                  rule.weights[j] * grid.density(patch.face, x, y));
    }
  }
}

// The same on both sides of the diagonal: squares that have shrunk to a corner.
template <typename Visit>
void visit_triangles(const SkyGrid& grid, const SkyPatch& patch, const SkyRule& rule,
                     Visit&& visit) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(rule.count); ++i) {
    for (std::size_t j = 0; j < static_cast<std::size_t>(rule.count); ++j) {
      const double a = rule.places[i], b = (1 - a) * rule.places[j];
      const double weight =
          patch.width * patch.height * rule.weights[i] * rule.weights[j] * (1 - a);
      for (const auto& [x, y] : {std::array{a, b}, std::array{1 - a, 1 - b}}) {
        const double on_face_x = patch.x + patch.width * x, on_face_y = patch.y + patch.height * y;
        visit(grid.direction(patch.face, on_face_x, on_face_y),
              weight * grid.density(patch.face, on_face_x, on_face_y));
      }
    }
  }
}

// Of the one that the patch asks for.
template <typename Visit>
void visit_points(const SkyGrid& grid, const SkyPatch& patch, const SkyRule& rule, Visit&& visit) {
  if (grid.is_bent(patch)) {
    visit_triangles(grid, patch, sky_rules.back(), visit);
  } else {
    visit_square(grid, patch, rule, visit);
  }
}

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
