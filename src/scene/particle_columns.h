#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "scene/memory_advice.h"
#include "splotchcl/particles.h"

namespace splotchcl {

// Particles [begin, end) of those that a pass goes over.
struct ParticleRun {
  std::size_t begin = 0, end = 0;
};

// Ranks that make passes over the same particles together.
class PassRanks {
 public:
  using Bytes = std::vector<std::byte>;

  PassRanks() = default;
  PassRanks(const PassRanks&) = delete;
  PassRanks& operator=(const PassRanks&) = delete;
  virtual ~PassRanks() = default;

  // Collective: every rank has what all ranks gave, by rank.
  virtual std::vector<Bytes> gather(const Bytes& own) const = 0;
  // Around a rank's looking at particles of its own, and at no others.
  virtual void begin_own() const {}
  virtual void end_own() const {}
};

// A pass over all particles of a column or a component: what follows from all of them is found
// through one. A process by itself looks at all. Of several ranks each looks at runs of its own,
// and afterwards all know what any of them has found, in the order of the particles: so what they
// make of it has the bits of one process.
class ParticlePass {
 public:
  // By this process alone.
  explicit ParticlePass(std::size_t count) : own_{{0, count}} {}
  // All ranks have as many runs. The first runs of all ranks follow each other, then the second
  // ones, and so on.
  ParticlePass(std::vector<ParticleRun> own, std::shared_ptr<const PassRanks> ranks)
      : own_(std::move(own)), ranks_(std::move(ranks)) {}

  // Collective. `look(run, found)` looks at one of this rank's runs and appends what it finds to
  // the vector `found`. Returns what all ranks have found.
  template <class T, class Look>
  std::vector<T> collect(const Look& look) const {
    static_assert(std::is_trivially_copyable_v<T>);
    std::vector<T> found;
    std::vector<std::size_t> ends;  // bytes, of each run
    look_at_own([&](const ParticleRun& run) {
      look(run, found);
      ends.push_back(found.size() * sizeof(T));
    });
    if (!ranks_) return found;
    PassRanks::Bytes bytes(found.size() * sizeof(T));
    if (!bytes.empty()) std::memcpy(bytes.data(), found.data(), bytes.size());
    bytes = in_order(std::move(bytes), ends);
    found.resize(bytes.size() / sizeof(T));
    if (!bytes.empty()) std::memcpy(found.data(), bytes.data(), bytes.size());
    return found;
  }

 private:
  template <class Look>
  void look_at_own(const Look& look) const {
    const Own own(ranks_.get());
    for (const ParticleRun& run : own_)
      look(run);
  }

  // Ends where the work throws as well.
  class Own {
   public:
    explicit Own(const PassRanks* ranks) : ranks_(ranks) {
      if (ranks_ != nullptr) ranks_->begin_own();
    }
    Own(const Own&) = delete;
    Own& operator=(const Own&) = delete;
    ~Own() {
      if (ranks_ != nullptr) ranks_->end_own();
    }

   private:
    const PassRanks* ranks_;
  };

  PassRanks::Bytes in_order(PassRanks::Bytes own, const std::vector<std::size_t>& ends) const;

  std::vector<ParticleRun> own_;
  std::shared_ptr<const PassRanks> ranks_;  // null: this process alone
};

// Columns of particles, which are made as they are wanted, stretch by stretch, where they are too
// large to be held in memory.

// Values [begin, end) of a column: in place where they lie in memory, else made. Of a uniform
// column all are the same.
class ColumnStretch {
 public:
  ColumnStretch(const Column& column, std::size_t begin, std::size_t end);
  ColumnStretch(const ColumnStretch&) = delete;
  ColumnStretch& operator=(const ColumnStretch&) = delete;

  // `i` counts from the column's first value, as in Column.
  float operator[](std::size_t i) const { return values_ == nullptr ? same_ : values_[i - begin_]; }

 private:
  std::size_t begin_;
  std::unique_ptr<float[]> made_;
  const float* values_ = nullptr;
  float same_ = 0;
};

// The same values into memory of one's own. Streamed ones are made there.
void copy_values(const Column& column, std::size_t begin, std::size_t end, float* out);

// Whether its values are made as they are wanted.
bool is_streamed(const Column& column);
// Whether those of any of their columns are.
bool has_streamed_column(const Particles& particles);

// So many particles at a time.
constexpr std::size_t streamed_particles = std::size_t{1} << 18;

// Calls use(begin, end) for stretches of a run of particles, one after the other.
template <class Use>
void for_stretches(const ParticleRun& run, Use&& use) {
  for (std::size_t begin = run.begin; begin < run.end; begin += streamed_particles)
    use(begin, begin + streamed_particles < run.end ? begin + streamed_particles : run.end);
}
template <class Use>
void for_stretches(std::size_t count, Use&& use) {
  for_stretches(ParticleRun{0, count}, use);
}

// Writes values [begin, end) of a column.
using MakeValues = std::function<void(std::size_t begin, std::size_t end, float* values)>;

// A column of `size` values: held in memory, or streamed.
Column make_column(std::size_t size, bool is_streamed, MakeValues make);

// A vector of each vector: held in memory, or streamed.
Column make_vectors(const Column& vectors, bool is_streamed,
                    const std::function<void(const double* from, double* to)>& make);

// Those of particles place(0) < place(1) < ... of an array with `width` values for each: `count` of
// them, in memory.
Column gather_in_order(const Column& column, std::size_t width, std::size_t count,
                       const std::function<std::size_t(std::size_t)>& place);

// Whether both have as many particles and the same columns: the same memory, the same that makes
// their values, or the same value for all. Whoever keeps `known` keeps its memory alive, so that no
// other column can have come to lie there. No value is made. Origins and boxes are not compared.
bool have_same_columns(const Particles& known, const Particles& particles);

// Calls work(first, last) for the blocks of [0, count), perhaps on several threads.
using RunBlocks = std::function<void(std::size_t count, std::size_t block,
                                     const std::function<void(std::size_t, std::size_t)>& work)>;
inline void run_as_one(std::size_t count, std::size_t,
                       const std::function<void(std::size_t, std::size_t)>& work) {
  work(0, count);
}

// Values of a column, `width` for each particle, of those at these places.
Column picked_column(const Column& column, std::size_t width, const Places& places,
                     const RunBlocks& run);

// The particles at these places, in memory. Values that are made when they are wanted are made for
// these alone, particle by particle.
Particles picked_particles(const Particles& particles, const Places& places,
                           const RunBlocks& run = run_as_one);

}  // namespace splotchcl
