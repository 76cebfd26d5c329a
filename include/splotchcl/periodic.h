#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "splotchcl/vector.h"

namespace splotchcl {

// The sides of a periodic box along x, y and z, in the unit of positions.
class BoxSides {
 public:
  // A cube. Converts, since most boxes are one.
  BoxSides(double side) : sides_({{side, side, side}}) {}
  explicit BoxSides(const Vec3& sides) : sides_(sides) {}

  double operator[](std::size_t axis) const { return sides_.a[axis]; }
  const Vec3& vector() const { return sides_; }
  double longest() const;
  bool is_cube() const;
  // Whether all are finite and above 0, as those of a box are.
  bool are_lengths() const;
  // "64", or "4 x 1 x 1".
  std::string text() const;

  friend bool operator==(const BoxSides& a, const BoxSides& b) {
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
  }
  friend bool operator!=(const BoxSides& a, const BoxSides& b) { return !(a == b); }

 private:
  Vec3 sides_;
};

// Of a file that says one side for all axes or one for each; nothing where there is another count
// of numbers or one that is no length.
std::optional<BoxSides> box_of(const std::vector<double>& sides);

// How far d lies from the nearest multiple of `side`: d - side * round(d / side).
double nearest_image(double d, double side);

// A periodic box: a particle stands for its images at every multiple of the box's sides. With
// `wrap` the image nearest to the look-at point is drawn (the nearest along each axis by itself).
struct PeriodicSettings {
  bool wrap = false;
  std::optional<BoxSides> box;  // lengths > 0, in the snapshot's unit; unset: as its header says
};

}  // namespace splotchcl
