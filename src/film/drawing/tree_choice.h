#pragma once

#include "splotchcl/frame.h"
#include "splotchcl/tree_use.h"

namespace splotchcl {

// Whether a frame is drawn from the trees of its components.
bool uses_tree(const Frame& frame, TreeUse use);

}  // namespace splotchcl
