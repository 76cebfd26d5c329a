#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "scene/particle_columns.h"
#include "splotchcl/communicator.h"
#include "splotchcl/particles.h"

namespace splotchcl {

class SpreadParticles;

// A column of values of which each rank has a stretch in its memory: rank 0 the first ones. The
// others come from their ranks, in the way that the particles are in at that time.
// For one thread.
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

// The columns of particles that are spread over ranks. While a frame is decided, loaded and
// planned, all ranks ask for the same values at the same time, and all get them: so all decide
// alike. While it is drawn, each has fetched before what it will ask for. For one thread.
class SpreadParticles : public std::enable_shared_from_this<SpreadParticles> {
 public:
  explicit SpreadParticles(std::shared_ptr<Communicator> ranks);

  Communicator& ranks() const { return *ranks_; }

  // Collective: the columns of all ranks, one after the other; each has so many particles in its
  // own. One value for all stays so.
  Column spread(const Column& own, std::uint64_t own_particles, std::size_t values_per_particle);
  // Collective: of each rank, by rank.
  std::vector<std::uint64_t> gather(std::uint64_t own);

  // Collective: does the work, in which all ranks ask for the same values. Where it throws on one
  // of them, the others do not wait for it: it throws on all, as agree() does.
  void agree_on(const std::function<void()>& work);

  // Between them each rank asks for values of its own.
  void begin_own() { mode_ = Mode::own; }
  void end_own() { mode_ = Mode::together; }

  // Collective: `ask` asks for what this rank will ask for until forget(), and gets zeros.
  void fetch(const std::function<void()>& ask);
  void forget();

 private:
  friend class SpreadColumn;

  enum class Mode {
    together,  // all ranks ask for the same
    own,       // each asks for its own
    asking,    // what is asked for is noted
    drawing,   // it has been fetched
  };
  struct Fetched {
    std::size_t begin;
    std::vector<float> values;
    std::size_t end() const { return begin + values.size(); }
  };
  using Stretch = SpreadColumn::Stretch;
  using Stretches = std::map<std::uint64_t, std::vector<Stretch>>;  // by column

  // For columns.
  bool is_asking() const { return mode_ == Mode::asking; }
  bool reads_from_others() const { return mode_ == Mode::together; }
  void ask(std::uint64_t column, std::size_t begin, std::size_t end);
  void read(const SpreadColumn& column, std::size_t begin, std::size_t end, float* values);
  void forget_column(std::uint64_t number) { columns_.erase(number); }

  void read_together(const SpreadColumn& column, std::size_t begin, std::size_t end,
                     float* values) const;
  bool read_here(const SpreadColumn& column, std::size_t begin, std::size_t end,
                 float* values) const;
  const Fetched* find_fetched(std::uint64_t column, std::size_t value) const;
  Communicator::Bytes request_to(int rank) const;
  Communicator::Bytes answer(const Communicator::Bytes& request) const;
  void keep(int from, const Communicator::Bytes& values);

  std::shared_ptr<Communicator> ranks_;
  Mode mode_ = Mode::together;
  std::uint64_t next_number_ = 0;
  std::map<std::uint64_t, const SpreadColumn*> columns_;  // those that live
  Stretches wanted_;
  std::map<std::uint64_t, std::map<std::size_t, Fetched>> fetched_;  // by column and first value
};

// Ranks of a communicator that make a pass together, within agree(): where one of them fails, the
// others do not wait for what it would have found.
class RankPass final : public PassRanks {
 public:
  // Of particles that all ranks can read.
  explicit RankPass(std::shared_ptr<Communicator> ranks) : ranks_(std::move(ranks)) {}
  // Of particles of which each rank has its own.
  explicit RankPass(std::shared_ptr<SpreadParticles> spread) : spread_(std::move(spread)) {}

  std::vector<Bytes> gather(const Bytes& own) const override;
  void begin_own() const override;
  void end_own() const override;

 private:
  std::shared_ptr<Communicator> ranks_;  // one of both
  std::shared_ptr<SpreadParticles> spread_;
};

// Equal runs of `count` particles that all ranks can read; all of them for this process alone where
// `ranks` is null.
ParticlePass shared_pass(const std::shared_ptr<Communicator>& ranks, std::size_t count);

}  // namespace splotchcl
