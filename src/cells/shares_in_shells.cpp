#include "cells/shares_in_shells.h"

#include <algorithm>

namespace splotchcl {

void add_shares_in_shells(const std::vector<double>& edges, double distance, double sigma,
                          std::vector<CellShare>& shares) {
  const double reach = kernel_reach * sigma;
  const auto above = std::upper_bound(edges.begin(), edges.end(), distance - reach);
  const auto begin = above == edges.begin() ? edges.begin() : above - 1;
  for (auto edge = begin; edge + 1 < edges.end() && *edge < distance + reach; ++edge) {
    const double part = gaussian_in_shell(distance, *edge, *(edge + 1), sigma);
    if (part > 0) shares.push_back({static_cast<std::size_t>(edge - edges.begin()), part});
  }
}

}  // namespace splotchcl
