#include <algorithm>

#include "splotchcl/reference.h"

namespace splotchcl::reference {

void sort(std::vector<Splat>& splats, const SortOrder& order) {
  if (order.descending) {
    std::stable_sort(splats.begin(), splats.end(),
                     [](const Splat& a, const Splat& b) { return a.key > b.key; });
  } else {
    std::stable_sort(splats.begin(), splats.end(),
                     [](const Splat& a, const Splat& b) { return a.key < b.key; });
  }
}

}  // namespace splotchcl::reference
