#pragma once

#include "splotchcl/frame.h"
#include "splotchcl/tree_use.h"

namespace splotchcl {

// Whether a frame is drawn from the trees of its components.
bool uses_tree(const Frame& frame, TreeUse use);

// Whether it may be, as far as is known without a look at the trees.
bool may_use_tree(const Frame& frame, TreeUse use);

}  // namespace splotchcl
