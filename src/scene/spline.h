#pragma once

#include <vector>

namespace splotchcl {

// How values between knots are found:
//   linear     straight lines
//   natural    the cubic spline with continuous second derivative, zero at both ends: the
//              smoothest motion, which may swing beyond its knots
//   monotone   cubics after Fritsch & Carlson (SIAM J. Numer. Anal. 17, 238, 1980): between
//              two knots the value never leaves the interval of theirs
enum class SplineKind { linear, natural, monotone };

// A curve through values at given places; before the first and after the last it stays
// what it is there.
class Spline {
 public:
  // `knots` increase strictly; as many values, at least one.
  Spline(std::vector<double> knots, std::vector<double> values, SplineKind kind);

  double at(double place) const;

 private:
  std::vector<double> knots_, values_;
  std::vector<double> slopes_;  // at the knots; empty: straight lines
};

// The interval of `knots`, at least two, that holds `place`, by its first knot's index.
// Places beyond the ends belong to the outermost intervals.
std::size_t find_interval(const std::vector<double>& knots, double place);

}  // namespace splotchcl
