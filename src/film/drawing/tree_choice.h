#pragma once

#include "splotchcl/frame.h"
#include "splotchcl/tree_use.h"
#include "tree/merged_drawing.h"
#include "tree/tree_cut.h"

namespace splotchcl {

// Whether a frame is drawn from the trees of its components.
inline bool uses_tree(const Frame& frame, TreeUse use) {
  if (use == TreeUse::never || frame.tolerance == 0) return false;
  return use == TreeUse::only ? has_served_component(frame) : tree_pays(frame);
}

// Whether it may be, as far as is known without a look at the trees.
inline bool may_use_tree(const Frame& frame, TreeUse use) {
  if (use == TreeUse::never || frame.tolerance == 0 || !has_served_component(frame)) return false;
  return use == TreeUse::only || has_particles_for_tree(frame);
}

}  // namespace splotchcl
