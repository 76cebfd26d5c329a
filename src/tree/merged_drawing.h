#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "splotchcl/frame.h"
#include "splotchcl/image.h"

namespace splotchcl {

// What a frame took that was drawn of a tree's nodes, and what was found of its errors.
struct MergedDrawing {
  Image image;
  std::uint64_t nodes = 0, particles = 0;  // that were drawn
  std::uint64_t visited = 0;               // nodes that were looked at
  std::uint64_t bytes = 0;                 // of the tree, for these
  double estimate = 0;                     // of what nodes err by, over what is promised
  int cuts = 0;                            // that were drawn until it served
  int verified_blocks = 0;                 // of 16 x 16 pixels
  // The largest difference there from a cut four times as fine, over what is promised. An estimate,
  // as the promise of merged particles is.
  double found = 0;
};

// Whether so many particles lie over a pixel that a tree may take less time than they do.
bool has_particles_for_tree(const Frame& frame);

// Whether a tree serves some of a frame, and so many particles lie over a pixel that it takes less
// time than they do (docs/dev/performance.md).
bool tree_pays(const Frame& frame);

// A line of the first cut of such a frame, without drawing it.
std::string explain_tree(const Frame& frame);

// Draws a frame with nodes in place of particles (tree_cut.h), so that nodes take seven tenths of
// its tolerance. A share of the picture's blocks, those where nodes might err alike and others, is
// drawn again from a finer cut. Where they differ by more than two thirds of the tolerance, they
// and blocks like them are cut finer: the finer cut may err by a quarter as much the same way.
// Nothing where that does not help, or, where it has to pay, would take longer than the particles:
// they have to be drawn.
std::optional<MergedDrawing> draw_merged(const Frame& frame,
                                         const std::function<Image(const Frame&)>& draw,
                                         bool has_to_pay = false);

}  // namespace splotchcl
