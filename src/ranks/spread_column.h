#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "splotchcl/particles.h"

namespace splotchcl {

class SpreadParticles;

// A column of values of which each rank has a stretch in its memory: rank 0 the first ones. The
// others come from their ranks, in the way that the particles are in at that time
// (spread_particles.h). For one thread.
class SpreadColumn final : public ColumnSource {
 public:
  // `begins` has the first value of each rank, and behind them the number of values.
  SpreadColumn(std::shared_ptr<SpreadParticles> spread, std::uint64_t number, Column own,
               std::vector<std::size_t> begins);
  ~SpreadColumn() override;

  std::uint64_t number() const { return number_; }
  std::size_t size() const override { return begins_.back(); }
  bool is_streamed() const override { return true; }
  void make(std::size_t begin, std::size_t end, float* values) const override;

  // The stretch of a rank, as far as it lies in [begin, end).
  struct Stretch {
    std::size_t begin, end;
    bool is_empty() const { return begin >= end; }
    std::size_t count() const { return end - begin; }
  };
  Stretch of_rank(int rank, std::size_t begin, std::size_t end) const;
  // Values of this rank's own stretch.
  void copy_own(const Stretch& stretch, float* values) const;

 private:
  void make_from_block(std::size_t begin, std::size_t end, float* values) const;
  void read_block(std::size_t begin) const;

  std::shared_ptr<SpreadParticles> spread_;
  std::uint64_t number_;
  Column own_;
  std::vector<std::size_t> begins_;
  // Values that were read last, for those who ask for them one by one.
  mutable std::size_t block_begin_ = 0;
  mutable std::vector<float> block_;
};

}  // namespace splotchcl
