#include "map/cell_sums.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "parallel/for_blocks.h"

namespace splotchcl {

Amounts::Amounts(const MapQuantity& quantity, std::size_t count, double unit,
                 const std::function<bool(std::size_t)>& is_good)
    : quantity_(quantity), unit_(unit), is_good_(count) {
  using Kind = MapQuantity::Kind;
  if (quantity.kind == Kind::mean) kinds_ = 2;
  if (quantity.kind == Kind::dispersion) kinds_ = 3;
  double weights = 0, values = 0;
  for (std::size_t i = 0; i < count; ++i) {
    is_good_[i] = is_good(i) && quantity.is_good(i);
    if (!is_good_[i]) ++bad_;
    if (kinds_ < 3 || !is_good_[i]) continue;
    weights += weight_of(i);
    values += weight_of(i) * static_cast<double>(quantity.value[i]);
  }
  if (weights > 0) middle_ = values / weights;
  totals_.resize(kinds_);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t kind = 0; kind < kinds_; ++kind)
      totals_[kind] += std::abs((*this)(i, kind));
  }
}

double Amounts::weight_of(std::size_t i) const {
  return unit_ * static_cast<double>(quantity_.weight[i]);
}

double Amounts::value_of(std::size_t i) const {
  return static_cast<double>(quantity_.value[i]) - middle_;
}

double Amounts::operator()(std::size_t i, std::size_t kind) const {
  if (!is_good_[i]) return 0;
  double amount = weight_of(i);
  for (std::size_t power = 0; power < kind; ++power)
    amount *= value_of(i);
  return amount;
}

CellSums::CellSums(std::size_t kind_count, std::size_t cells)
    : kinds(kind_count, std::vector<double>(cells, 0.0)) {}

namespace {

void add(const Amounts& amounts, std::size_t particle, const CellShare* first,
         const CellShare* last, CellSums& sums) {
  for (std::size_t kind = 0; kind < amounts.kinds(); ++kind) {
    const double amount = amounts(particle, kind);
    for (const CellShare* share = first; share != last; ++share)
      sums.kinds[kind][share->cell] += amount * share->part;
  }
}

// Particles that follow each other, and where the shares of each begin.
struct Block {
  std::vector<CellShare> shares;
  std::vector<std::size_t> begins;
};

}  // namespace

void add_up_shares(const Amounts& amounts, const std::vector<std::uint32_t>& source,
                   const FindShares& find, const ExpectedShares& expected,
                   const std::function<void(double)>& progress, CellSums& sums) {
  constexpr std::size_t most_particles = 65536, block_size = 64;
  constexpr double most_shares = 1 << 22;  // what is held at a time, unless one has more
  const std::size_t count = source.size();
  for (std::size_t first = 0; first < count;) {
    std::size_t last = first;
    double shares = 0;
    while (last < count && last - first < most_particles &&
           (last == first || shares + expected(last) <= most_shares))
      shares += expected(last++);
    std::vector<Block> blocks((last - first + block_size - 1) / block_size);
    for_blocks(last - first, block_size, [&](std::size_t from, std::size_t to) {
      Block& block = blocks[from / block_size];
      for (std::size_t i = first + from; i < first + to; ++i) {
        block.begins.push_back(block.shares.size());
        find(i, block.shares);
      }
      block.begins.push_back(block.shares.size());
    });
    for (std::size_t i = first; i < last; ++i) {
      const Block& block = blocks[(i - first) / block_size];
      const CellShare* const begin = block.shares.data();
      const std::size_t in_block = (i - first) % block_size;
      add(amounts, source[i], begin + block.begins[in_block], begin + block.begins[in_block + 1],
          sums);
    }
    first = last;
    if (progress) progress(static_cast<double>(first) / static_cast<double>(count));
  }
}

std::vector<double> values_of(const CellSums& sums, const Amounts& amounts,
                              const std::function<double(std::size_t)>& size, double floor) {
  using Kind = MapQuantity::Kind;
  const std::vector<double>& weight = sums.kinds[0];
  std::vector<double> values(weight.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t cell = 0; cell < values.size(); ++cell) {
    if (!(size(cell) > 0)) continue;
    if (amounts.kind() == Kind::counts) values[cell] = weight[cell];
    if (amounts.kind() == Kind::column) values[cell] = weight[cell] / size(cell);
    if (amounts.kinds() == 1 || !(weight[cell] > 0) || weight[cell] < floor * size(cell)) continue;
    const double mean = sums.kinds[1][cell] / weight[cell];
    values[cell] = mean + amounts.middle();
    if (amounts.kinds() < 3) continue;
    // Rounding may leave a hair below 0 where all values are the same.
    values[cell] = std::sqrt(std::max(0.0, sums.kinds[2][cell] / weight[cell] - mean * mean));
  }
  return values;
}

}  // namespace splotchcl
