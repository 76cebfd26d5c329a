#include "cells/shares_on_the_sky.h"

#include <algorithm>
#include <array>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>

#include "cells/sky_grid.h"
#include "scene/constants.h"

namespace splotchcl {
namespace {

using namespace boost::qvm;

struct SeenPatch {
  SkyPatch patch;
  Vec3 direction;  // to its middle
};

class SkySpread {
 public:
  SkySpread(const SkyGrid& grid, const GaussianOnSky& particle, const SkyAccuracy& accuracy,
            std::vector<CellShare>& shares)
      : grid_(grid),
        particle_(particle),
        accuracy_(accuracy),
        reach_(reach_that_counts(particle, accuracy)),
        shares_(shares) {}

  // Down to whole cells.
  void find_cells(const SkyPatch& patch, std::vector<SeenPatch>& cells) const {
    const Vec3 direction = middle_of(patch);
    if (is_out_of_reach(patch, direction)) return;
    if (patch.width <= 1 && patch.height <= 1) {
      cells.push_back({patch, direction});
      return;
    }
    for (const SkyPatch& part : parts_of(patch, false))
      find_cells(part, cells);
  }

  // One in reach.
  void visit(const SeenPatch& seen) {
    const auto& [patch, direction] = seen;
    if (const SkyRule* const rule = rule_for(patch, direction)) {
      add(patch, *rule);
      return;
    }
    for (const SkyPatch& part : parts_of(patch, true)) {
      const Vec3 middle = middle_of(part);
      if (!is_out_of_reach(part, middle)) visit({part, middle});
    }
  }

 private:
  Vec3 middle_of(const SkyPatch& patch) const {
    return grid_.direction(patch.face, patch.x + 0.5 * patch.width, patch.y + 0.5 * patch.height);
  }

  bool is_out_of_reach(const SkyPatch& patch, const Vec3& direction) const {
    const double farthest = reach_ + grid_.radius(patch);
    if (farthest >= pi) return false;
    // The chord has digits where the cosine of small angles has none.
    const double chord = 2 * std::sin(0.5 * farthest);
    return mag_sqr(direction - particle_.middle()) > chord * chord;
  }

  // The first one whose error is allowed; null where the patch is too large for all. Errors follow
  // from how steep the particle is there; far out, where little is left, they do not count.
  const SkyRule* rule_for(const SkyPatch& patch, const Vec3& direction) const {
    const double out = std::sqrt(particle_.square(direction));
    const double side = grid_.longest_side(patch) / particle_.width();
    const double nearest = std::max(0.0, out - grid_.radius(patch) / particle_.width());
    const double left = std::exp(-std::min(nearest * nearest, 700.0));
    const double allowed = accuracy_.tolerance * std::max(1.0, accuracy_.floor / left);
    constexpr double least_slope = 2.5;  // of a Gaussian's derivatives in its middle
    const double slope = std::max(least_slope, 2 * out) * side;
    const double square = slope * slope, fourth = square * square;
    const std::array<double, sky_rules.size()> errors = {square, fourth, fourth * fourth};
    for (std::size_t i = 0; i < sky_rules.size(); ++i) {
      if (errors[i] < allowed * sky_rules[i].divisor) return &sky_rules[i];
    }
    return nullptr;
  }

  // A quarter each; as long as there are some, of whole cells.
  static std::vector<SkyPatch> parts_of(const SkyPatch& patch, bool is_in_cell) {
    const auto half = [is_in_cell](double side) {
      return is_in_cell ? 0.5 * side : std::ceil(0.5 * side);
    };
    const double width = half(patch.width), height = half(patch.height);
    const double other_width = patch.width - width, other_height = patch.height - height;
    std::vector<SkyPatch> parts = {{patch.face, patch.x, patch.y, width, height}};
    if (other_width > 0)
      parts.push_back({patch.face, patch.x + width, patch.y, other_width, height});
    if (other_height > 0)
      parts.push_back({patch.face, patch.x, patch.y + height, width, other_height});
    if (other_width > 0 && other_height > 0)
      parts.push_back({patch.face, patch.x + width, patch.y + height, other_width, other_height});
    return parts;
  }

  void add(const SkyPatch& patch, const SkyRule& rule) {
    double part = 0;
    visit_points(grid_, patch, rule, [&](const Vec3& direction, double weight) {
      part += weight * particle_(direction);
    });
    if (!(part > 0)) return;
    const std::size_t cell = grid_.cell(patch.face, static_cast<int>(std::floor(patch.x)),
                                        static_cast<int>(std::floor(patch.y)));
    if (!shares_.empty() && shares_.back().cell == cell && shares_.size() > first_) {
      shares_.back().part += part;
    } else {
      shares_.push_back({cell, part});
    }
  }

  const SkyGrid& grid_;
  const GaussianOnSky& particle_;
  SkyAccuracy accuracy_;
  double reach_;
  std::vector<CellShare>& shares_;
  std::size_t first_ = shares_.size();
};

void bring_to_one(std::size_t first, std::vector<CellShare>& shares) {
  double sum = 0;
  for (std::size_t i = first; i < shares.size(); ++i)
    sum += shares[i].part;
  if (!(sum > 0)) return;
  for (std::size_t i = first; i < shares.size(); ++i)
    shares[i].part /= sum;
}

}  // namespace

double reach_that_counts(const GaussianOnSky& particle, const SkyAccuracy& accuracy) {
  constexpr double hair = 1e-3;
  const double least = std::clamp(hair * accuracy.tolerance * accuracy.floor, 1e-300, 1e-2);
  return particle.reach_of(std::log(1 / least));
}

void add_shares_on_the_sky(const SkyGrid& grid, const GaussianOnSky& particle,
                           const SkyAccuracy& accuracy, std::vector<CellShare>& shares) {
  // So narrow that coordinates have no digits left to tell its edges by.
  constexpr double a_point = 1e-11;
  if (particle.width() < a_point) {
    if (const auto cell = grid.cell_at(particle.middle())) shares.push_back({*cell, 1});
    return;
  }
  const std::size_t first = shares.size();
  SkySpread spread(grid, particle, accuracy, shares);
  std::vector<SeenPatch> cells;
  for (const SkyPatch& face : grid.faces())
    spread.find_cells(face, cells);
  const bool has_all = grid.has_all_of_the_sky();
  if (has_all && cells.size() == 1) {
    const SkyPatch& only = cells.front().patch;
    shares.push_back({grid.cell(only.face, static_cast<int>(only.x), static_cast<int>(only.y)), 1});
    return;
  }
  for (const SeenPatch& cell : cells)
    spread.visit(cell);
  if (has_all) bring_to_one(first, shares);
}

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
