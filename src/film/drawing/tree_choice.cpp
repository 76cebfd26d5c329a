#include "film/drawing/tree_choice.h"

#include "tree/merged_drawing.h"
#include "tree/tree_cut.h"

namespace splotchcl {

bool uses_tree(const Frame& frame, TreeUse use) {
  if (use == TreeUse::never || frame.tolerance == 0) return false;
  return use == TreeUse::only ? has_served_component(frame) : tree_pays(frame);
}

bool may_use_tree(const Frame& frame, TreeUse use) {
  if (use == TreeUse::never || frame.tolerance == 0 || !has_served_component(frame)) return false;
  return use == TreeUse::only || has_particles_for_tree(frame);
}

}  // namespace splotchcl
