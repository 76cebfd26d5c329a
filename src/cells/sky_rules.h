#pragma once

#include <array>
#include <cstddef>

#include "cells/sky_grid.h"

namespace splotchcl {

// Points of Gauss and Legendre along an axis from 0 to 1, exact to the order 2 `count` - 1; errors
// are the next even derivative over `divisor`, times the side of a patch to that power.
struct SkyRule {
  int count;
  double divisor;
  std::array<double, 4> places, weights;
};

constexpr std::array<SkyRule, 3> sky_rules = {{
    {1, 24, {0.5}, {1}},
    {2, 4320, {0.2113248654051871, 0.7886751345948129}, {0.5, 0.5}},
    {4,
     1778112000,
     {0.0694318442029737, 0.3300094782075719, 0.6699905217924281, 0.9305681557970263},
     {0.1739274225687269, 0.3260725774312731, 0.3260725774312731, 0.1739274225687269}},
}};

// Calls visit(direction, weight) for points whose values, times their weights, add up to the
// integral over a patch, in cells.
template <typename Visit>
void visit_square(const SkyGrid& grid, const SkyPatch& patch, const SkyRule& rule, Visit&& visit) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(rule.count); ++i) {
    for (std::size_t j = 0; j < static_cast<std::size_t>(rule.count); ++j) {
      const double x = patch.x + patch.width * rule.places[i],
                   y = patch.y + patch.height * rule.places[j];
      visit(grid.direction(patch.face, x, y), patch.width * patch.height * rule.weights[i] *
                                                  rule.weights[j] * grid.density(patch.face, x, y));
    }
  }
}

// The same on both sides of the diagonal: squares that have shrunk to a corner.
template <typename Visit>
void visit_triangles(const SkyGrid& grid, const SkyPatch& patch, const SkyRule& rule,
                     Visit&& visit) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(rule.count); ++i) {
    for (std::size_t j = 0; j < static_cast<std::size_t>(rule.count); ++j) {
      const double a = rule.places[i], b = (1 - a) * rule.places[j];
      const double weight =
          patch.width * patch.height * rule.weights[i] * rule.weights[j] * (1 - a);
      for (const auto& [x, y] : {std::array{a, b}, std::array{1 - a, 1 - b}}) {
        const double on_face_x = patch.x + patch.width * x, on_face_y = patch.y + patch.height * y;
        visit(grid.direction(patch.face, on_face_x, on_face_y),
              weight * grid.density(patch.face, on_face_x, on_face_y));
      }
    }
  }
}

// Of the one that the patch asks for.
template <typename Visit>
void visit_points(const SkyGrid& grid, const SkyPatch& patch, const SkyRule& rule, Visit&& visit) {
  if (grid.is_bent(patch)) {
    visit_triangles(grid, patch, sky_rules.back(), visit);
  } else {
    visit_square(grid, patch, rule, visit);
  }
}

}  // namespace splotchcl
