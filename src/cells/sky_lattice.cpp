#include "cells/sky_lattice.h"

#include <algorithm>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>

#include "scene/constants.h"

namespace splotchcl {
namespace {

using namespace boost::qvm;

constexpr std::size_t taps = SkyLattice::Stencil::taps;
// Beyond each edge of a face; so many are needed to find those of the next level.
constexpr std::size_t margin = taps;
// From edge to edge of a face, of the coarsest level.
constexpr int fewest_steps = 32;
constexpr double steps_in_width = 6;

double spacing_of(int level) {
  return std::ldexp(0.5 * pi / fewest_steps, -level);
}

// Of the polynomial through the values at 0, 1, ... at x: the product of the distances to all
// others, over what it is at the point itself.
std::array<double, taps> weights_at(double x) {
  constexpr double own[taps] = {-362880, 40320, -10080, 4320,   -2880,
                                2880,    -4320, 10080,  -40320, 362880};
  std::array<double, taps> weights{};
  double before = 1, behind = 1;
  for (std::size_t k = 0; k < taps; ++k) {
    weights[k] = before / own[k];
    before *= x - static_cast<double>(k);
  }
  for (std::size_t k = taps; k-- > 0;) {
    weights[k] *= behind;
    behind *= x - static_cast<double>(k);
  }
  return weights;
}

std::size_t axis_of(int face, int turn) {
  return static_cast<std::size_t>((face / 2 + turn) % 3);
}

double sign_of(int face) {
  return face % 2 == 0 ? 1 : -1;
}

int face_of(const Vec3& direction) {
  int face = 0;
  for (int axis = 1; axis < 3; ++axis) {
    if (std::abs(direction.a[axis]) > std::abs(direction.a[face / 2])) face = 2 * axis;
  }
  return direction.a[face / 2] < 0 ? face + 1 : face;
}

std::size_t side_of(int level) {
  return (std::size_t{fewest_steps} << level) + 2 * margin + 1;
}

// One line of values at twice as many points.
class Halving {
 public:
  Halving() : between_(weights_at(0.5 * (taps - 1))) {}

  double at(const double* line, std::size_t stride, std::size_t fine) const {
    // Half of the margin lies as far from the edge as all of the finer one.
    const std::size_t twice = fine + margin;
    if (twice % 2 == 0) return line[twice / 2 * stride];
    const double* const first = line + ((twice - 1) / 2 - (taps / 2 - 1)) * stride;
    double sum = 0;
    for (std::size_t k = 0; k < taps; ++k)
      sum += between_[k] * first[k * stride];
    return sum;
  }

 private:
  std::array<double, taps> between_;
};

}  // namespace

SkyLattice::SkyLattice(int level)
    : spacing_(spacing_of(level)), side_(side_of(level)), tangents_(side_) {
  for (std::size_t i = 0; i < side_; ++i) {
    const double step = static_cast<double>(i) - static_cast<double>(margin);
    tangents_[i] = std::tan(step * spacing_ - 0.25 * pi);
  }
}

int SkyLattice::level_for(double width) {
  const double needed = std::log2(steps_in_width * spacing_of(0) / width);
  return std::max(0, static_cast<int>(std::ceil(needed)));
}

std::size_t SkyLattice::points_of(int level) {
  return 6 * side_of(level) * side_of(level);
}

SkyLattice::Range SkyLattice::range_of(double depth, double along, double reach) const {
  const double across = std::hypot(depth, along);
  if (reach >= 0.5 * pi || std::sin(reach) >= across) return {0, side_};
  const double half = std::asin(std::sin(reach) / across), middle = std::atan2(along, depth);
  const auto place = [this](double angle) {
    const double step = (angle + 0.25 * pi) / spacing_ + static_cast<double>(margin);
    return static_cast<std::size_t>(std::clamp(step, 0.0, static_cast<double>(side_)));
  };
  const Range range = {place(middle - half), std::min(side_, place(middle + half) + 1)};
  return range.first < range.end ? range : Range();
}

void SkyLattice::add_values(const GaussianOnSky& particle, double reach,
                            std::vector<CellShare>& values) const {
  const Vec3& middle = particle.middle();
  const double nearest = reach < pi ? std::cos(reach) : -2;
  for (int face = 0; face < 6; ++face) {
    const double depth = sign_of(face) * middle.a[axis_of(face, 0)];
    const double along = middle.a[axis_of(face, 1)], up = middle.a[axis_of(face, 2)];
    const Range columns = range_of(depth, along, reach), rows = range_of(depth, up, reach);
    for (std::size_t row = rows.first; row < rows.end; ++row) {
      const double y = tangents_[row];
      const std::size_t line = (static_cast<std::size_t>(face) * side_ + row) * side_;
      for (std::size_t column = columns.first; column < columns.end; ++column) {
        const double x = tangents_[column];
        const double towards = depth + along * x + up * y, square = 1 + x * x + y * y;
        // As the cosine of the angle between them, without a root.
        if (towards * std::abs(towards) < nearest * std::abs(nearest) * square) continue;
        const double part = 1 / std::sqrt(square);
        Vec3 direction;
        direction.a[axis_of(face, 0)] = sign_of(face) * part;
        direction.a[axis_of(face, 1)] = x * part;
        direction.a[axis_of(face, 2)] = y * part;
        values.push_back({line + column, particle(direction)});
      }
    }
  }
}

std::vector<double> SkyLattice::refined(const std::vector<double>& values) const {
  const Halving halving;
  const std::size_t fine = 2 * (side_ - 2 * margin - 1) + 2 * margin + 1;
  std::vector<double> finer(6 * fine * fine), wide(side_ * fine);
  for (std::size_t face = 0; face < 6; ++face) {
    const double* const from = values.data() + face * side_ * side_;
    double* const to = finer.data() + face * fine * fine;
    for (std::size_t row = 0; row < side_; ++row) {
      for (std::size_t column = 0; column < fine; ++column)
        wide[row * fine + column] = halving.at(from + row * side_, 1, column);
    }
    for (std::size_t row = 0; row < fine; ++row) {
      for (std::size_t column = 0; column < fine; ++column)
        to[row * fine + column] = halving.at(wide.data() + column, fine, row);
    }
  }
  return finer;
}

SkyLattice::Stencil SkyLattice::stencil_at(const Vec3& direction) const {
  const int face = face_of(direction);
  const double depth = sign_of(face) * direction.a[axis_of(face, 0)];
  const auto step = [&](int turn) {
    const double angle = std::atan(direction.a[axis_of(face, turn)] / depth);
    return (angle + 0.25 * pi) / spacing_ + static_cast<double>(margin - (taps / 2 - 1));
  };
  const double x = step(1), y = step(2);
  const auto column = static_cast<std::size_t>(x), row = static_cast<std::size_t>(y);
  const double middle = taps / 2 - 1;
  Stencil stencil;
  stencil.first = (static_cast<std::size_t>(face) * side_ + row) * side_ + column;
  stencil.stride = side_;
  stencil.along = weights_at(x - static_cast<double>(column) + middle);
  stencil.across = weights_at(y - static_cast<double>(row) + middle);
  return stencil;
}

double SkyLattice::Stencil::of(const std::vector<double>& values) const {
  double sum = 0;
  for (std::size_t row = 0; row < taps; ++row) {
    const double* const line = values.data() + first + row * stride;
    double of_row = 0;
    for (std::size_t k = 0; k < taps; ++k)
      of_row += along[k] * line[k];
    sum += across[row] * of_row;
  }
  return sum;
}

}  // namespace splotchcl
