#include "tree/tree_preview.h"

#include <algorithm>
#include <utility>

#include "tree/tree_cut.h"

namespace splotchcl {
namespace {

constexpr double least_footprint_pixels = 0.5;
constexpr double finer = 1.6, most_error = 1e6, least_error = 1e-7;

std::uint64_t splats_of(const TreeCut& cut) {
  return cut.nodes + cut.particles;
}

}  // namespace

std::optional<Frame> TreePreview::of(const Frame& frame, std::uint64_t most_splats) {
  Frame seen = frame;
  seen.kernel.footprint_pixels = std::max(least_footprint_pixels, frame.kernel.footprint_pixels);
  const bool is_possible =
      frame.kernel.min_radius_pixels == 0 &&
      std::all_of(seen.components.begin(), seen.components.end(),
                  [&](const DrawnComponent& component) { return is_served(seen, component); });
  if (!is_possible) return std::nullopt;
  TreeCut cut = cut_tree(seen, {error_, {}, 0});
  while (splats_of(cut) > most_splats) {
    error_ *= finer;
    if (error_ > most_error) {
      error_ = 1;
      return std::nullopt;
    }
    cut = cut_tree(seen, {error_, {}, 0});
  }
  while (splats_of(cut) < most_splats / 2 && error_ > least_error) {
    TreeCut next = cut_tree(seen, {error_ / finer, {}, 0});
    if (splats_of(next) > most_splats) break;
    error_ /= finer;
    cut = std::move(next);
  }
  return std::move(cut.frame);
}

}  // namespace splotchcl
