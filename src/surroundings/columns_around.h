#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

#include "splotchcl/frame.h"
#include "surroundings/cloud_around.h"

namespace splotchcl {

// Which clouds around the camera show in which part of the picture. A cloud shows in all directions
// only where the camera is in it: of those that are many sigma away a pixel has a small part.
class CloudsInBlocks {
 public:
  // Of clouds [first, end).
  CloudsInBlocks(const std::vector<CloudAround>& clouds, std::size_t first, std::size_t end,
                 const Frame& frame);

  CloudsInBlocks(const std::vector<CloudAround>&&, std::size_t, std::size_t, const Frame&) = delete;

  // Numbers of all clouds that may show in pixel (x, y), one of many that lie `spacing` pixels
  // apart, in their order. Of the others no more is lost than by their ending
  // (CloudAround::farthest2). Blocks are looked through at the first pixels that lie so close that
  // several share one. Several threads may ask.
  const std::vector<std::uint32_t>& at(int x, int y, int spacing) const;

 private:
  void look_through_blocks() const;

  const std::vector<CloudAround>& clouds_;
  const Frame& frame_;
  int columns_, rows_;  // of blocks
  std::vector<std::uint32_t> all_;
  mutable std::once_flag are_known_;
  mutable std::vector<std::vector<std::uint32_t>> of_blocks_;  // once they are
};

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
