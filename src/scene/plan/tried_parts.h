#pragma once

#include <cstddef>
#include <vector>

#include "scene/plan/cloud_sample.h"
#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// How bright a whole picture is likely to be, from its clouds or a sample of them, in square cells:
// their light or depth, whichever is more, as if nothing were in front of it.
class LightMap {
 public:
  LightMap(const std::vector<SampledCloud>& clouds, const Frame& frame);

  // Of the brightest cell.
  double brightest() const;
  // A quarter of all cells are brighter.
  double of_bright_quarter() const;
  // Where a frame of this light is likely to need most: beside the brightest cell, where narrow
  // clouds stand out most, and at the edge of the picture; not where its own light hides errors.
  // With pixels around them, and none twice.
  std::vector<Rectangle> telling_parts(LightPlan light) const;

 private:
  struct Cell {
    double light = 0, narrow = 0;  // of all clouds, and of narrow ones
    double beside = 0;             // of those beside the picture that reach it here
    std::size_t clouds = 0;
  };
  bool is_at_edge(const Cell& cell) const;
  // The most of the cell and those beside it.
  Cell most_around(const Cell& cell) const;
  Rectangle part_around(const Cell& cell) const;

  int width_, height_;
  int columns_, rows_;
  std::vector<Cell> cells_;
};

}  // namespace splotchcl
