#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "scene/particle_pass.h"
#include "splotchcl/particles.h"

// Columns of particles, which are made as they are wanted, stretch by stretch, where they are too
// large to be held in memory.
namespace splotchcl {

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
  std::vector<float> made_;
  const float* values_ = nullptr;
  float same_ = 0;
};

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

// The particles at these places, in memory. Values that are made when they are wanted are made for
// these alone, particle by particle.
Particles picked_particles(const Particles& particles, const std::vector<std::uint64_t>& places,
                           const RunBlocks& run = run_as_one);

}  // namespace splotchcl
