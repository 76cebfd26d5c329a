#pragma once

#include <cstdint>
#include <vector>

#include "splotchcl/frame.h"
#include "splotchcl/frame_check.h"
#include "tree/particle_tree.h"

namespace splotchcl {

struct CutSettings {
  // Six standard deviations of what nodes err by are at most this, over max(1, light) in sums.
  double error = 0;
  // Only what may be seen here is drawn, for a frame of this crop; none: the frame's crop.
  std::vector<Rectangle> regions;
  // So often limits are corrected by what nodes were found to err by. Without, a cut is quick and
  // keeps its error only roughly: nodes across the faces of a periodic box are not opened.
  int corrections = 2;
  // Nodes and particles are counted, where their places lie in the regions, and not drawn.
  bool only_counts = false;
  // Which part of the error nodes of each block of the crop may take; none: all of it.
  BlockErrors parts_of_error = {};
};

// A frame in which nodes stand for particles where they err by little enough.
struct TreeCut {
  Frame frame;  // of each component with a tree two: nodes, and particles
  std::uint64_t nodes = 0, particles = 0;
  std::uint64_t visited = 0;  // nodes that were looked at
  std::uint64_t bytes = 0;    // of the tree, for these
  // Six standard deviations of what nodes err by, over max(1, light / 2) in sums: the largest.
  double estimate = 0;
  // Of each block of the crop, over max(1, light): what all its nodes would err by together if they
  // erred alike.
  BlockErrors alike;
};

// Whether nodes can stand for particles in this frame, and for which components (docs/tree.md,
// What is not served).
bool is_served(const Frame& frame, const DrawnComponent& component);
bool has_served_component(const Frame& frame);

// Looks at nodes from the roots on, level by level. Deterministic: the same
// nodes on any number of threads. Throws DataError where a tree's own numbers do not fit.
TreeCut cut_tree(const Frame& frame, const CutSettings& settings);

}  // namespace splotchcl
