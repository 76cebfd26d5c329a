#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

namespace splotchcl {

struct PictureCloud {
  double x = 0, y = 0, sigma = 0;  // pixels of the whole picture
  double of_lens = 0;              // by which a lens widens it, likewise (drawn_width())
  double depth = 0;                // as that of Projected
  double column = 0;               // through its centre, times its intensity, before colour
};

// Particle i of the component. Nothing for one that is bad or outside the camera's limits.
std::optional<PictureCloud> cloud_in_picture(const DrawnComponent& component, const Frame& frame,
                                             std::size_t i);

// A particle that may be seen in the picture.
struct SampledCloud {
  double x = 0, y = 0;  // pixels of the whole picture
  double sigma = 0;     // pixels, with kernel.min_radius
  double light = 0;     // or depth, whichever is more, in a pixel: of narrow ones their flux
  double weight = 1;    // particles that it stands for
};

// Calls work(first, last) for all blocks of `count` things, in any order.
using BlockLoop = std::function<void(std::size_t count, std::size_t block_size,
                                     const std::function<void(std::size_t, std::size_t)>& work)>;

// By the calling thread alone.
void one_after_the_other(std::size_t count, std::size_t block_size,
                         const std::function<void(std::size_t, std::size_t)>& work);

// All particles of a frame of at most 65536, of others at most 32768, those that the whole picture
// does not show left out. The same in every run, and whatever crop is drawn. Of a file that is
// mapped each is a page that the system has to find, so columns that are arrays are looked at
// by `loop`.
std::vector<SampledCloud> sample_clouds(const Frame& frame,
                                        const BlockLoop& loop = one_after_the_other);

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
  Cell most_around(const Cell& cell) const;
  Rectangle part_around(const Cell& cell) const;

  int width_, height_;
  int columns_, rows_;
  std::vector<Cell> cells_;
};

}  // namespace splotchcl
