#pragma once

#include <cstddef>
#include <optional>
#include <vector>

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

}  // namespace splotchcl
