#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "cells/shares_on_the_sky.h"
#include "map/quantity.h"

namespace splotchcl {

// What is added up in cells, of each particle: its weight, and that times its value and the value's
// square, as far as the quantity needs them.
class Amounts {
 public:
  // `unit` is what weights are multiplied by.
  Amounts(const MapQuantity& quantity, std::size_t count, double unit,
          const std::function<bool(std::size_t)>& is_good);

  std::size_t kinds() const { return kinds_; }
  // 0 for a bad particle.
  double operator()(std::size_t i, std::size_t kind) const;
  // Of absolute amounts.
  double total(std::size_t kind) const { return totals_[kind]; }
  bool is_good(std::size_t i) const { return is_good_[i]; }
  std::size_t bad() const { return bad_; }
  MapQuantity::Kind kind() const { return quantity_.kind; }
  // The mean of all, from which a dispersion's deviations are taken; else 0.
  double middle() const { return middle_; }

 private:
  double weight_of(std::size_t i) const;
  double value_of(std::size_t i) const;

  const MapQuantity& quantity_;
  double unit_ = 1, middle_ = 0;
  std::size_t kinds_ = 1, bad_ = 0;
  std::vector<bool> is_good_;
  std::vector<double> totals_;
};

// Sums of amounts, cell by cell.
struct CellSums {
  CellSums(std::size_t kinds, std::size_t cells);

  std::vector<std::vector<double>> kinds;
};

// Adds up what `find` tells of each image, of the particle `source` says, in about `expected`
// cells, on all cores. Additions are in the order of images, so that sums do not depend on the
// cores.
using FindShares = std::function<void(std::size_t, std::vector<CellShare>&)>;
using ExpectedShares = std::function<double(std::size_t)>;
void add_up_shares(const Amounts& amounts, const std::vector<std::uint32_t>& source,
                   const FindShares& find, const ExpectedShares& expected,
                   const std::function<void(double)>& progress, CellSums& sums);

// What a map shows in each cell of this size: sums per size, or means where the weights per size
// reach the floor, and not a number elsewhere.
std::vector<double> values_of(const CellSums& sums, const Amounts& amounts,
                              const std::function<double(std::size_t)>& size, double floor);

}  // namespace splotchcl
