#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "ranks/spread_column.h"
#include "splotchcl/communicator.h"
#include "splotchcl/particles.h"

namespace splotchcl {

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

}  // namespace splotchcl
