#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>

#include "splotchcl/particles.h"

namespace splotchcl::test {

// A column as one that is read when it is wanted, and remembers how many values were.
class CountedColumn final : public ColumnSource {
 public:
  explicit CountedColumn(Column values) : values_(std::move(values)) {}
  std::size_t size() const override { return values_.size(); }
  bool is_streamed() const override { return true; }
  void make(std::size_t begin, std::size_t end, float* values) const override {
    std::copy(values_.data() + begin, values_.data() + end, values);
    made_ += end - begin;
  }
  std::size_t made() const { return made_; }

 private:
  Column values_;
  mutable std::size_t made_ = 0;
};

}  // namespace splotchcl::test
