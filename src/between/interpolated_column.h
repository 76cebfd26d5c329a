#pragma once

#include "between/interpolation.h"

namespace splotchcl {

// The values of a column between two snapshots. Devices make them by themselves.
class InterpolatedColumn final : public ColumnSource {
 public:
  explicit InterpolatedColumn(ColumnBetween interpolation)
      : interpolation_(std::move(interpolation)) {}

  const ColumnBetween& interpolation() const { return interpolation_; }
  std::size_t size() const override;
  void make(std::size_t begin, std::size_t end, float* values) const override;
  std::vector<float> make_all() const override;  // on all cores

 private:
  ColumnBetween interpolation_;
};

// The column; uniform where both snapshots have the same one value and nothing fades.
Column column_between(ColumnBetween interpolation);

// Null for a column that is not interpolated.
std::shared_ptr<const InterpolatedColumn> interpolated(const Column& column);

// A column times another one that only fades, value by value.
Column faded(const Column& column, const Column& fade, std::size_t count);

}  // namespace splotchcl
