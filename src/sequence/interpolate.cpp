#include "sequence/interpolate.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "parallel/for_blocks.h"

namespace splotchcl {
namespace {

constexpr std::size_t block_size = 16384;

using Point = std::array<double, 3>;

std::size_t particles_after(const IdMatch& match) {
  return match.place_in_second.size() + match.appearing.size();
}

double mean_of(double a, double b, double fraction) {
  return a == b ? a : a + fraction * (b - a);
}

double geometric_mean_of(double a, double b, double fraction) {
  if (!(a > 0) || !(b > 0)) return mean_of(a, b, fraction);
  return a == b ? a : a * std::pow(b / a, fraction);
}

// Calls set(i, a, b) with a particle's places in the result, the first and the second
// snapshot; nobody where it is not.
template <class Set>
void for_particles(const IdMatch& match, Set&& set) {
  const std::size_t in_first = match.place_in_second.size();
  for_blocks(particles_after(match), block_size, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (i < in_first) {
        set(i, static_cast<std::uint32_t>(i), match.place_in_second[i]);
      } else {
        set(i, IdMatch::nobody, match.appearing[i - in_first]);
      }
    }
  });
}

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

// Only what has left the period is moved, so that nothing else is rounded.
double wrapped(double x, const std::optional<PeriodicRange>& period) {
  if (!period || (x >= period->lower && x < period->lower + period->size)) return x;
  return x - period->size * std::floor((x - period->lower) / period->size);
}

// The four weights of a cubic by values and tangents; of x0 it is what is left of 1.
struct HermiteWeights {
  explicit HermiteWeights(double f)
      : displacement(f * f * (3 - 2 * f)),
        tangent0(f * (1 - f) * (1 - f)),
        tangent1(f * f * (f - 1)) {}
  double displacement, tangent0, tangent1;
};

bool lies_within(const Column& position, const Vec3& origin, const PeriodicRange& range) {
  for (std::size_t i = 0; i < position.size(); ++i) {
    if (!std::isfinite(position[i])) continue;
    const double x = origin.a[i % 3] + static_cast<double>(position[i]);
    if (x < range.lower || x > range.lower + range.size) return false;
  }
  return true;
}

}  // namespace

Column interpolate_values(const Column& first, const Column& second, int values_per_particle,
                          const IdMatch& match, double fraction, bool logarithmic) {
  const bool is_uniform =
      first.is_uniform() && second.is_uniform() && first.uniform_value() == second.uniform_value();
  if (is_uniform) return first;
  const auto width = static_cast<std::size_t>(values_per_particle);
  std::vector<float> values(particles_after(match) * width);
  for_particles(match, [&](std::size_t i, std::uint32_t a, std::uint32_t b) {
    for (std::size_t k = 0; k < width; ++k) {
      float& value = values[i * width + k];
      if (a == IdMatch::nobody) {
        value = second[b * width + k];
      } else if (b == IdMatch::nobody) {
        value = first[a * width + k];
      } else {
        const double x = static_cast<double>(first[a * width + k]);
        const double y = static_cast<double>(second[b * width + k]);
        value = static_cast<float>(logarithmic ? geometric_mean_of(x, y, fraction)
                                               : mean_of(x, y, fraction));
      }
    }
  });
  return Column::owning(std::move(values));
}

std::optional<PeriodicRange> find_periodic_range(double box, const Column& first,
                                                 const Vec3& first_origin, const Column& second,
                                                 const Vec3& second_origin) {
  for (const double lower : {0.0, -0.5 * box}) {
    const PeriodicRange range = {lower, box};
    if (lies_within(first, first_origin, range) && lies_within(second, second_origin, range)) {
      return range;
    }
  }
  return std::nullopt;
}

Column interpolate_positions(const PathEnd& first, const PathEnd& second, const IdMatch& match,
                             double fraction, const std::optional<PeriodicRange>& period) {
  const bool is_straight = first.velocity.is_absent() || second.velocity.is_absent();
  const HermiteWeights weights(fraction);
  std::vector<float> positions(3 * particles_after(match));
  for_particles(match, [&](std::size_t i, std::uint32_t a, std::uint32_t b) {
    const bool is_in_first = a != IdMatch::nobody, is_in_second = b != IdMatch::nobody;
    const Point x0 = is_in_first ? position_of(first, a) : position_of(second, b);
    const Point x1 = is_in_second ? position_of(second, b) : x0;
    const Point m0 = is_in_first ? tangent_of(first, a) : Point{0, 0, 0};
    const Point m1 = is_in_second ? tangent_of(second, b) : Point{0, 0, 0};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double way = shorter_way(x1[axis] - x0[axis], period);
      double moved = 0;
      if (!is_in_second) {
        moved = fraction * m0[axis];
      } else if (!is_in_first) {
        moved = (fraction - 1) * m1[axis];
      } else if (is_straight) {
        moved = fraction * way;
      } else {
        moved =
            weights.displacement * way + weights.tangent0 * m0[axis] + weights.tangent1 * m1[axis];
      }
      positions[3 * i + axis] =
          static_cast<float>(wrapped(x0[axis] + moved, period) - first.origin.a[axis]);
    }
  });
  return Column::owning(std::move(positions));
}

Column fade(const IdMatch& match, double fraction) {
  std::vector<float> values(particles_after(match));
  for_particles(match, [&](std::size_t i, std::uint32_t a, std::uint32_t b) {
    values[i] = 1;
    if (a == IdMatch::nobody) values[i] = static_cast<float>(fraction);
    if (b == IdMatch::nobody) values[i] = static_cast<float>(1 - fraction);
  });
  return Column::owning(std::move(values));
}

std::optional<double> tangent_ratio(const PathEnd& first, const PathEnd& second,
                                    const IdMatch& match,
                                    const std::optional<PeriodicRange>& period) {
  double of_tangents = 0, of_ways = 0;
  for (std::size_t a = 0; a < match.place_in_second.size(); ++a) {
    const std::uint32_t b = match.place_in_second[a];
    if (b == IdMatch::nobody) continue;
    const Point x0 = position_of(first, a), x1 = position_of(second, b);
    const Point m0 = tangent_of(first, a), m1 = tangent_of(second, b);
    double tangent = 0, way = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      tangent += std::pow(0.5 * (m0[axis] + m1[axis]), 2);
      way += std::pow(shorter_way(x1[axis] - x0[axis], period), 2);
    }
    if (!std::isfinite(tangent) || !std::isfinite(way)) continue;
    of_tangents += tangent;
    of_ways += way;
  }
  if (!(of_tangents > 0) || !(of_ways > 0)) return std::nullopt;
  return std::sqrt(of_tangents / of_ways);
}

}  // namespace splotchcl
