#pragma once

#include <array>
#include <cstddef>

#include "splotchcl/frame.h"
#include "surroundings/cloud_around.h"

namespace splotchcl {

// Pixels of a row, some of its columns, and the directions in which they are seen.
class PixelsOfRow {
 public:
  static constexpr std::size_t most = 32;
  template <class Number>
  using OfPixels = std::array<Number, most>;

  // `count` of them, at most `most`.
  PixelsOfRow(const int* columns, std::size_t count, int row, const Frame& frame);

  std::size_t count;
  int y;
  OfPixels<int> x{};
  OfPixels<double> right{}, down{}, forward{};  // unit vectors
};

// The width in pixels from which on the mean of a splat over a pixel follows from the value at its
// center, and derivatives there, up to this part of itself.
double sigma_of_means_by_values(double error);

// The cloud's columns in these pixels, of a central one of 1: what rays find in front of the
// camera, and its splats; to 3e-14 of themselves. False where they are all 0. Splats wider than
// `wide_sigma` pixels take means by values.
bool columns_around(const CloudAround& cloud, const PixelsOfRow& pixels,
                    const KernelSettings& kernel, double wide_sigma,
                    PixelsOfRow::OfPixels<double>& columns);

}  // namespace splotchcl
