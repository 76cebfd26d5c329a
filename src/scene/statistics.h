#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "scene/ceil_divide.h"
#include "scene/particle_columns.h"
#include "splotchcl/frame.h"
#include "splotchcl/particles.h"
#include "splotchcl/scene.h"

namespace splotchcl {

struct ValueRange {
  double minimum = 0;
  double maximum = 0;
};

// The largest sample is every so many-th of `count` things: what is found in the data is the same
// in every run.
constexpr std::size_t most_sampled = 2000000;
inline std::size_t least_sample_stride(std::size_t count) {
  return count == 0 ? 1 : ceil_divide(count, most_sampled);
}

// Every so many-th, for `limit` of them at most: all of them of the largest sample, which a tree
// keeps (src/tree/tree_file.h). `limit` is most_sampled at most.
inline std::size_t sample_stride(std::size_t count, std::size_t limit) {
  const std::size_t least = least_sample_stride(count);
  return count <= limit ? 1 : ceil_divide(ceil_divide(count, limit), least) * least;
}

// The first of every `stride`-th particle that lies in the run, or one behind it.
inline std::size_t first_sampled(const ParticleRun& run, std::size_t stride) {
  return ceil_divide(run.begin, stride) * stride;
}

// Which of the `stride` things from `first` on is looked at, below `count`: any of them, but the
// same in every run. A pattern that repeats in a file cannot keep step with it.
std::size_t sampled_index(std::size_t first, std::size_t stride, std::size_t count);

// The value below which `fraction` of the values lie, linear between neighbours.
// `values` must not be empty; their order is lost.
double percentile(std::vector<double>& values, double fraction);

// The scaled values that are finite, of at most most_sampled evenly spaced in the column. Here and
// below ranks share the pass over the column's particles, each of which has one value; without it
// this process looks at all.
std::vector<double> sample_scaled(const Column& column, Scaling scaling, const ParticlePass& pass);
std::vector<double> sample_scaled(const Column& column, Scaling scaling);

// Where the bulk of the scaled values lies: 0.5 % to 99.5 %, so that a few outliers do
// not squeeze all others into one colour. Nothing when no value is finite.
std::optional<ValueRange> bulk_range(const Column& column, Scaling scaling,
                                     const ParticlePass& pass);
std::optional<ValueRange> bulk_range(const Column& column, Scaling scaling);

// Between two percentiles of the scaled values, given in per cent. 0 and 100 are the
// smallest and largest of all of them, others of those that are sampled.
std::optional<ValueRange> percentile_range(const Column& column, Scaling scaling, double low,
                                           double high, const ParticlePass& pass);

// The column of matter that should count as 1 so that brightness 1 is a good picture of
// this component, whatever the units of its masses and lengths. Nothing when the camera
// sees none of its particles. `component.reference_column` itself is not looked at. Ranks share the
// pass over its particles, each of which stands for so many; without it this process looks at all.
std::optional<double> find_reference_column(const DrawnComponent& component, const Frame& frame,
                                            const ParticlePass& pass, std::size_t stands_for = 1);
std::optional<double> find_reference_column(const DrawnComponent& component, const Frame& frame);

// Minimum, maximum and mean are of the finite values; 0 where there are none.
struct FieldStatistics {
  std::size_t count = 0;  // all values, three for each vector
  std::size_t bad = 0;    // not-a-number or infinite
  std::size_t infinite = 0;
  double minimum = 0;
  double maximum = 0;
  double mean = 0;
};

// What the user should know of infinite values: few files have any, but many have numbers that are
// read as such.
std::string advice_on_infinite_values();

// Of all values of a column, in one pass. A uniform column counts as one value.
FieldStatistics find_statistics(const Column& values);

}  // namespace splotchcl
