#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "splotchcl/particles.h"
#include "splotchcl/periodic.h"

namespace splotchcl {

// Which particles of two snapshots are the same.
struct IdMatch {
  static constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();

  // For each particle of the first its place in the second, or nobody: it vanishes.
  std::vector<std::uint32_t> place_in_second;
  std::vector<std::uint32_t> appearing;  // places in the second, in its order
  std::size_t in_common = 0;
  // Particles, of both, that share their id with others of their snapshot: which of them is
  // which cannot be told, so they vanish and appear.
  std::size_t ambiguous = 0;

  std::size_t particles() const { return place_in_second.size() + appearing.size(); }
};

// On all cores; the same for any number of them. Up to 2^32 - 2 particles each, else throws
// DataError.
IdMatch match_ids(const std::vector<std::uint64_t>& first,
                  const std::vector<std::uint64_t>& second);

// One period of positions along each axis, [lower, lower + size), in the true coordinates.
struct PeriodicRange {
  Vec3 lower = {{0, 0, 0}};
  BoxSides size = 0;
};

// The numbers of a path between two snapshots, in single precision: what host and kernels compute
// with them, they compute bit for bit alike (kernels/interpolate/).
struct PathNumbers {
  // What is added to the second's positions to count from the first's origin, as a sum of two.
  float shift_high[3] = {0, 0, 0}, shift_low[3] = {0, 0, 0};
  // The period, as a sum of two, and where it begins and ends; is_periodic is false without one.
  bool is_periodic = false;
  float size_high[3] = {0, 0, 0}, size_low[3] = {0, 0, 0}, inverse_size[3] = {0, 0, 0};
  float lower[3] = {0, 0, 0}, upper[3] = {0, 0, 0};
  // From stored velocities to tangents: the path's change over the interval.
  float first_rate = 0, second_rate = 0;
  // Of a cubic by values and tangents.
  bool is_straight = true;
  float of_way = 0, of_first_tangent = 0, of_second_tangent = 0;
  // For those that vanish and appear: how far along their tangent.
  float from_first = 0, from_second = 0;
};

// How a column between two snapshots follows from theirs.
struct ColumnBetween {
  enum class Kind {
    linear,       // a + f (b - a)
    logarithmic,  // a^(1-f) b^f where both are normal numbers > 0, else linear
    position,     // along paths
  };

  std::shared_ptr<const IdMatch> match;
  Kind kind = Kind::linear;
  int values_per_particle = 1;  // 1 or 3; of positions 3
  Column first, second;         // as the snapshots have them; absent where a type is not in one
  float fraction = 0;           // f, of the way
  // Particles that vanish or appear are there only in part: their values are multiplied by these.
  bool fades = false;
  float vanishing = 1, appearing = 1;
  // Of positions.
  Column first_velocity, second_velocity;  // absent: without tangents
  PathNumbers path;
  std::string note;  // what a user should know of the paths; mostly nothing
};

// What a path's numbers follow from.
struct PathSetting {
  Vec3 first_origin = {{0, 0, 0}}, second_origin = {{0, 0, 0}};
  double first_rate = 0, second_rate = 0;
  bool is_straight = true;
  std::optional<PeriodicRange> period;
};
PathNumbers make_path_numbers(const PathSetting& setting, double fraction);

// Values [begin, end), those of the first snapshot's particles in its order, then of those that
// appear. Particles that vanish or appear keep the value that they have, or move on along their
// tangent.
void interpolate(const ColumnBetween& column, std::size_t begin, std::size_t end, float* values);

// The values of a column between two snapshots. Devices make them by themselves.
class InterpolatedColumn final : public ColumnSource {
 public:
  explicit InterpolatedColumn(ColumnBetween interpolation)
      : interpolation_(std::move(interpolation)) {}

  const ColumnBetween& interpolation() const { return interpolation_; }
  std::size_t size() const override;
  void make(std::size_t begin, std::size_t end, float* values) const override;
  Column make_all() const override;  // on all cores

 private:
  ColumnBetween interpolation_;
};

// The column; uniform where both snapshots have the same one value and nothing fades.
Column column_between(ColumnBetween interpolation);

// Null for a column that is not interpolated.
std::shared_ptr<const InterpolatedColumn> interpolated(const Column& column);

// A column times another one that only fades, value by value.
Column faded(const Column& column, const Column& fade, std::size_t count);

}  // namespace splotchcl
