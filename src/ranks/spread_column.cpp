#include "ranks/spread_column.h"

#include <algorithm>
#include <utility>

#include "ranks/spread_particles.h"
#include "scene/streamed_column.h"

namespace splotchcl {
namespace {

// Where values are asked for one after the other, more and more come at once.
constexpr std::size_t smallest_block = std::size_t{1} << 10;
constexpr std::size_t largest_block = std::size_t{1} << 18;

}  // namespace

SpreadColumn::SpreadColumn(std::shared_ptr<SpreadParticles> spread, std::uint64_t number,
                           Column own, std::vector<std::size_t> begins)
    : spread_(std::move(spread)),
      number_(number),
      own_(std::move(own)),
      begins_(std::move(begins)) {}

SpreadColumn::~SpreadColumn() {
  spread_->forget_column(number_);
}

SpreadColumn::Stretch SpreadColumn::of_rank(int rank, std::size_t begin, std::size_t end) const {
  const auto r = static_cast<std::size_t>(rank);
  return {std::max(begin, begins_[r]), std::min(end, begins_[r + 1])};
}

void SpreadColumn::copy_own(const Stretch& stretch, float* values) const {
  if (stretch.is_empty()) return;
  const std::size_t first = begins_[static_cast<std::size_t>(spread_->ranks().rank())];
  const ColumnStretch own(own_, stretch.begin - first, stretch.end - first);
  for (std::size_t i = stretch.begin; i < stretch.end; ++i)
    *values++ = own[i - first];
}

void SpreadColumn::make(std::size_t begin, std::size_t end, float* values) const {
  if (spread_->is_asking()) {
    spread_->ask(number_, begin, end);
    std::fill_n(values, end - begin, 0.0F);
  } else if (spread_->reads_from_others() && end - begin < smallest_block) {
    make_from_block(begin, end, values);
  } else {
    spread_->read(*this, begin, end, values);
  }
}

void SpreadColumn::make_from_block(std::size_t begin, std::size_t end, float* values) const {
  for (std::size_t i = begin; i < end; ++i) {
    if (i < block_begin_ || i >= block_begin_ + block_.size()) read_block(i);
    *values++ = block_[i - block_begin_];
  }
}

void SpreadColumn::read_block(std::size_t begin) const {
  const std::size_t before = block_.size();
  const bool goes_on =
      before > 0 && begin >= block_begin_ + before && begin < block_begin_ + 2 * before;
  const std::size_t length =
      goes_on ? std::clamp(2 * before, smallest_block, largest_block) : smallest_block;
  std::vector<float> block(std::min(length, size() - begin));
  spread_->read(*this, begin, begin + block.size(), block.data());
  block_ = std::move(block);
  block_begin_ = begin;
}

}  // namespace splotchcl
