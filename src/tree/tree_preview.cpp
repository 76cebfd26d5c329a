#include "tree/tree_preview.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tree/tree_cut.h"

namespace splotchcl {
namespace {

constexpr double least_footprint_pixels = 0.5;
constexpr double most_error = 1e6, least_error = 1e-7;
// Splats are about as many as this power of the error.
constexpr double power_of_error = -0.8, largest_step = 64, as_good_as_the_same = 1.1;

std::uint64_t splats_of(const TreeCut& cut) {
  return cut.nodes + cut.particles;
}

struct Fitting {
  double error;
  TreeCut cut;
};

}  // namespace

std::optional<Frame> TreePreview::of(const Frame& frame, std::uint64_t most_splats) {
  Frame seen = frame;
  seen.kernel.footprint_pixels = std::max(least_footprint_pixels, frame.kernel.footprint_pixels);
  const bool is_possible =
      frame.kernel.min_radius_pixels == 0 &&
      std::all_of(seen.components.begin(), seen.components.end(),
                  [&](const DrawnComponent& component) { return is_served(seen, component); });
  if (!is_possible) return std::nullopt;
  // The largest error that is known to take too many splats, and the least that fits.
  double too_many = least_error;
  std::optional<Fitting> fitting;
  while (true) {
    TreeCut cut = cut_tree(seen, {error_, {}, 0});
    const auto splats = static_cast<double>(splats_of(cut));
    const auto most = static_cast<double>(most_splats);
    if (splats <= most) {
      const bool is_enough = splats >= most / 2 || cut.nodes == 0;
      fitting = Fitting{error_, std::move(cut)};
      if (is_enough) break;
    } else {
      too_many = error_;
    }
    const bool is_found = fitting && fitting->error < as_good_as_the_same * too_many;
    const bool is_hopeless = !fitting && too_many >= most_error;
    if (is_found || is_hopeless) break;
    const double step = std::pow(splats / (0.7 * most), -1 / power_of_error);
    error_ *= std::clamp(step, 1 / largest_step, largest_step);
    error_ = std::clamp(error_, least_error, most_error);
    if (error_ <= too_many || (fitting && error_ >= fitting->error))
      error_ = fitting ? std::sqrt(too_many * fitting->error) : most_error;
  }
  error_ = fitting ? fitting->error : 1;
  if (!fitting) return std::nullopt;
  return std::move(fitting->cut.frame);
}

}  // namespace splotchcl
