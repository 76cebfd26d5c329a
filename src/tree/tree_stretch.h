#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

#include "parallel/for_blocks.h"
#include "scene/ceil_divide.h"
#include "scene/particle_columns.h"
#include "scene/particle_rules.h"
#include "tree/build_tree.h"

namespace splotchcl {

struct TreeCube {
  Vec3 lower = {{0, 0, 0}};  // of the positions as their column has them
  double side = 1;
};

// A stretch of a source's columns.
class TreeStretch {
 public:
  TreeStretch(const TreeSource& source, std::size_t begin, std::size_t end)
      : position_(source.position, 3 * begin, 3 * end),
        length_(source.smoothing_length, begin, end),
        has_weights_(!source.weights.is_absent()),
        weight_(source.weights, begin, end),
        model_(source.weight) {
    fields_.reserve(source.fields.size());
    for (const TreeSource::Field& field : source.fields)
      fields_.push_back(std::make_unique<ColumnStretch>(field.values, begin, end));
  }

  bool is_good(std::size_t i) const {
    const float at[3] = {position_[3 * i], position_[3 * i + 1], position_[3 * i + 2]};
    if (!is_finite_position(at) || !is_smoothing_length(length_[i])) return false;
    const double flux = this->flux(i);
    if (!std::isfinite(flux) || flux < 0) return false;
    return std::all_of(fields_.begin(), fields_.end(),
                       [i](const auto& field) { return std::isfinite((*field)[i]); });
  }
  std::array<double, 3> place(std::size_t i, const TreeCube& cube) const {
    std::array<double, 3> place{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      place[axis] = (static_cast<double>(position_[3 * i + axis]) - cube.lower.a[axis]) / cube.side;
    return place;
  }
  float position(std::size_t i, std::size_t axis) const { return position_[3 * i + axis]; }
  double h(std::size_t i) const { return static_cast<double>(length_[i]); }
  double flux(std::size_t i) const {
    const double weight = has_weights_ ? static_cast<double>(weight_[i]) : 1;
    if (model_ == WeightModel::mass) return weight;
    return model_ == WeightModel::constant ? weight * h(i) : weight * h(i) * h(i) * h(i);
  }
  MemberValues values(std::size_t i) const {
    MemberValues values{};
    for (std::size_t f = 0; f < fields_.size(); ++f)
      values[f] = (*fields_[f])[i];
    return values;
  }

 private:
  ColumnStretch position_, length_;
  bool has_weights_;
  ColumnStretch weight_;
  WeightModel model_;
  std::vector<std::unique_ptr<ColumnStretch>> fields_;
};

inline std::size_t stretches_of(const TreeSource& source) {
  return ceil_divide(static_cast<std::size_t>(source.count), streamed_particles);
}

// Calls look(stretch, begin, end) for those stretches of the source that are wanted, on all cores.
template <class IsWanted, class Look>
void for_some_stretches(const TreeSource& source, const IsWanted& is_wanted, const Look& look) {
  const std::size_t count = static_cast<std::size_t>(source.count);
  for_blocks(stretches_of(source), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t s = first; s < last; ++s) {
      if (!is_wanted(s)) continue;
      const std::size_t begin = s * streamed_particles;
      const std::size_t end = std::min(count, begin + streamed_particles);
      look(TreeStretch(source, begin, end), begin, end);
    }
  });
}
// For all of them.
template <class Look>
void for_source(const TreeSource& source, const Look& look) {
  for_some_stretches(
      source, [](std::size_t) { return true; }, look);
}

}  // namespace splotchcl
