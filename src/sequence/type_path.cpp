#include "sequence/type_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <vector>

#include "parallel/for_blocks.h"
#include "scene/ceil_divide.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

[[noreturn]] void refuse(const SnapshotInfo& info, const std::string& what) {
  throw UsageError(
      fmt::format("time.interpolation is \"hermite\", which needs velocities, but {}: {}; set "
                  "time.interpolation to \"linear\", or say what is missing",
                  info.files.front().string(), what));
}

std::optional<Cosmology> cosmology_of(const SnapshotInfo& info, const SequenceSettings& settings) {
  std::optional<Cosmology> cosmology = info.cosmology;
  // The scene says that there is one where the snapshot does not.
  if (!cosmology && settings.omega_matter && info.time > 0) {
    cosmology.emplace();
    cosmology->scale_factor = info.time;
  }
  if (!cosmology) return std::nullopt;
  cosmology->omega_matter = settings.omega_matter.value_or(cosmology->omega_matter);
  cosmology->omega_lambda = settings.omega_lambda.value_or(cosmology->omega_lambda);
  cosmology->hubble_rate = settings.hubble_rate.value_or(cosmology->hubble_rate);
  return cosmology;
}

// da as a change of comoving position per stored velocity.
double comoving_rate(const Cosmology& cosmology, const SnapshotInfo& info) {
  const double a = cosmology.scale_factor;
  const double hubble =
      cosmology.hubble_rate * expansion_rate(a, cosmology.omega_matter, cosmology.omega_lambda);
  if (!(hubble > 0) || !std::isfinite(hubble)) {
    refuse(info,
           fmt::format("its expansion rate is not known (omega_matter {}, omega_lambda {}, "
                       "hubble_rate {})",
                       cosmology.omega_matter, cosmology.omega_lambda, cosmology.hubble_rate));
  }
  return std::pow(a, cosmology.velocity_power) / (a * a * hubble);
}

}  // namespace

double expansion_rate(double scale_factor, double omega_matter, double omega_lambda) {
  const double z1 = 1 / scale_factor;
  const double curvature = 1 - omega_matter - omega_lambda;
  return std::sqrt(omega_matter * z1 * z1 * z1 + curvature * z1 * z1 + omega_lambda);
}

Motion find_motion(const SnapshotInfo& first, const SnapshotInfo& second,
                   const SequenceSettings& settings) {
  const auto cosmology = cosmology_of(first, settings);
  const auto second_cosmology = cosmology_of(second, settings);
  Motion motion;
  // A run without cosmology may happen to stop at a time that fits its redshift of 0.
  if (cosmology && second_cosmology) {
    motion.first_time = cosmology->scale_factor;
    motion.second_time = second_cosmology->scale_factor;
    motion.first_rate = comoving_rate(*cosmology, first);
    motion.second_rate = comoving_rate(*second_cosmology, second);
  } else {
    for (const SnapshotInfo* const info : {&first, &second}) {
      if (!info->velocity_doubt.empty()) refuse(*info, info->velocity_doubt);
    }
    motion.first_time = first.time;
    motion.second_time = second.time;
  }
  if (motion.first_time == motion.second_time) {
    refuse(second, fmt::format("it has the same time, {}, as {}", motion.second_time,
                               first.files.front().string()));
  }
  return motion;
}

namespace {

constexpr std::size_t block_size = 65536;

using Point = std::array<double, 3>;

Point position_of(const PathEnd& end, std::size_t i) {
  Point point;
  for (std::size_t axis = 0; axis < 3; ++axis)
    point[axis] = end.origin.a[axis] + static_cast<double>(end.position[3 * i + axis]);
  return point;
}

Point tangent_of(const PathEnd& end, std::size_t i) {
  if (end.velocity.is_absent()) return {0, 0, 0};
  Point tangent;
  for (std::size_t axis = 0; axis < 3; ++axis)
    tangent[axis] = static_cast<double>(end.velocity[3 * i + axis]) * end.rate;
  return tangent;
}

double shorter_way(double displacement, const std::optional<PeriodicRange>& period) {
  if (!period) return displacement;
  return displacement - period->size * std::round(displacement / period->size);
}

// Up to so much of a side beyond it particles have left the box since they were last put into it.
constexpr double just_left = 0.01;

bool lies_within(const Point& point, const PeriodicRange& range) {
  const double lowest = range.lower - just_left * range.size;
  const double highest = range.lower + (1 + just_left) * range.size;
  // What is no number lies nowhere else.
  return std::none_of(point.begin(), point.end(),
                      [&](double x) { return std::isfinite(x) && (x < lowest || x > highest); });
}

std::uint64_t count_outside(const PathEnd& of, const PeriodicRange& range) {
  std::atomic<std::uint64_t> outside{0};
  for_blocks(of.position.size() / 3, block_size, [&](std::size_t begin, std::size_t end) {
    std::uint64_t of_block = 0;
    for (std::size_t i = begin; i < end; ++i)
      of_block += !lies_within(position_of(of, i), range);
    outside += of_block;
  });
  return outside;
}

// Sums of squares of particles in both.
struct Squares {
  double of_tangents = 0, of_ways = 0;
};

Squares squares_of(const TypePath& path, std::size_t a, std::size_t b) {
  const Point x0 = position_of(path.first, a), x1 = position_of(path.second, b);
  const Point m0 = tangent_of(path.first, a), m1 = tangent_of(path.second, b);
  Squares squares;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    squares.of_tangents += std::pow(0.5 * (m0[axis] + m1[axis]), 2);
    squares.of_ways += std::pow(shorter_way(x1[axis] - x0[axis], path.period), 2);
  }
  return squares;
}

}  // namespace

ColumnBetween interpolate_positions(const TypePath& path, std::shared_ptr<const IdMatch> match,
                                    double fraction) {
  PathSetting setting;
  setting.first_origin = path.first.origin;
  setting.second_origin = path.second.origin;
  setting.first_rate = path.first.rate;
  setting.second_rate = path.second.rate;
  setting.is_straight = path.first.velocity.is_absent() || path.second.velocity.is_absent();
  setting.period = path.period;
  ColumnBetween positions;
  positions.match = std::move(match);
  positions.kind = ColumnBetween::Kind::position;
  positions.values_per_particle = 3;
  positions.first = path.first.position;
  positions.second = path.second.position;
  positions.fraction = static_cast<float>(fraction);
  positions.first_velocity = path.first.velocity;
  positions.second_velocity = path.second.velocity;
  positions.path = make_path_numbers(setting, fraction);
  positions.note = path.note;
  return positions;
}

FoundPeriod find_period(double box, const PathEnd& first, const PathEnd& second) {
  FoundPeriod found;
  found.particles = (first.position.size() + second.position.size()) / 3;
  found.outside = found.particles;
  for (const double lower : {0.0, -0.5 * box}) {
    const PeriodicRange range = {lower, box};
    const std::uint64_t outside = count_outside(first, range) + count_outside(second, range);
    if (lower == 0 || outside < found.outside) {
      found.range = range;
      found.outside = outside;
    }
    if (outside == 0) break;
  }
  return found;
}

// Blocks are added up in their order, so that the sum is the same on any number of cores.
std::optional<double> tangent_ratio(const TypePath& path, const IdMatch& match) {
  const std::size_t count = match.place_in_second.size();
  std::vector<Squares> blocks(ceil_divide(count, block_size));
  for_blocks(count, block_size, [&](std::size_t begin, std::size_t end) {
    Squares& sum = blocks[begin / block_size];
    for (std::size_t a = begin; a < end; ++a) {
      if (match.place_in_second[a] == IdMatch::nobody) continue;
      const Squares squares = squares_of(path, a, match.place_in_second[a]);
      if (!std::isfinite(squares.of_tangents) || !std::isfinite(squares.of_ways)) continue;
      sum.of_tangents += squares.of_tangents;
      sum.of_ways += squares.of_ways;
    }
  });
  Squares all;
  for (const Squares& block : blocks) {
    all.of_tangents += block.of_tangents;
    all.of_ways += block.of_ways;
  }
  if (!(all.of_tangents > 0) || !(all.of_ways > 0)) return std::nullopt;
  return std::sqrt(all.of_tangents / all.of_ways);
}

}  // namespace splotchcl
