#include <algorithm>

#include "splotchcl/reference.h"

namespace splotchcl::reference {

void sort(std::vector<Splat>& splats, const SortOrder& order) {
  if (order.descending) {
    std::stable_sort(splats.begin(), splats.end(), [](const Splat& a, const Splat& b) {
      return a.key != b.key ? a.key > b.key : !a.is_around && b.is_around;
    });
  } else {
    std::stable_sort(splats.begin(), splats.end(), [](const Splat& a, const Splat& b) {
      return a.key != b.key ? a.key < b.key : !a.is_around && b.is_around;
    });
  }
}

}  // namespace splotchcl::reference
