#pragma once

namespace splotchcl {

// When frames are drawn from a tree of merged particles beside their snapshot (docs/tree.md).
enum class TreeUse {
  automatic,  // where so many particles lie over a pixel that it pays
  never,
  only,  // or a UsageError where it cannot be
};

}  // namespace splotchcl
