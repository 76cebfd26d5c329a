// Single precision, one operation after the other, none of which may be joined with another or
// reordered: kernels/interpolate/interpolate.cl has the same ones, and division, roots and the
// functions of mathematics, which devices round in their own ways, are not among them.
#include "between/interpolation.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

#include "parallel/for_blocks.h"
#include "scene/ceil_divide.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

using Ids = std::vector<std::uint64_t>;

constexpr std::size_t ids_per_block = 65536;

struct IdPlace {
  std::uint64_t id;
  std::uint32_t place;
};

// Particles go into buckets by their ids, so that equal ids of both snapshots meet in one bucket,
// and buckets can be matched one by one, each in a core's nearest cache.
class Buckets {
 public:
  // 2^bits of them.
  Buckets(const Ids& ids, int bits) : bits_(bits), sorted_(ids.size()) {
    const std::size_t blocks = ceil_divide(ids.size(), ids_per_block);
    std::vector<std::size_t> begins(blocks * count());
    for_blocks(ids.size(), ids_per_block, [&](std::size_t begin, std::size_t end) {
      std::size_t* const of_block = begins.data() + begin / ids_per_block * count();
      for (std::size_t i = begin; i < end; ++i)
        ++of_block[bucket_of(ids[i])];
    });
    set_begins(begins, blocks);
    for_blocks(ids.size(), ids_per_block, [&](std::size_t begin, std::size_t end) {
      std::size_t* const next = begins.data() + begin / ids_per_block * count();
      for (std::size_t i = begin; i < end; ++i)
        sorted_[next[bucket_of(ids[i])]++] = {ids[i], static_cast<std::uint32_t>(i)};
    });
  }

  std::size_t count() const { return std::size_t{1} << bits_; }
  // Those of a bucket, by their ids.
  struct Range {
    IdPlace *begin, *end;
  };
  Range sort(std::size_t bucket) {
    const Range range = {sorted_.data() + begins_[bucket], sorted_.data() + begins_[bucket + 1]};
    std::sort(range.begin, range.end,
              [](const IdPlace& a, const IdPlace& b) { return a.id < b.id; });
    return range;
  }

 private:
  // Ids that follow each other, as most do, are spread evenly.
  std::size_t bucket_of(std::uint64_t id) const {
    return bits_ == 0 ? 0 : static_cast<std::size_t>(id * 0x9e3779b97f4a7c15u >> (64 - bits_));
  }

  // From how many of each bucket a block has to where it writes them.
  void set_begins(std::vector<std::size_t>& of_blocks, std::size_t blocks) {
    std::size_t total = 0;
    for (std::size_t bucket = 0; bucket < count(); ++bucket) {
      begins_.push_back(total);
      for (std::size_t block = 0; block < blocks; ++block) {
        std::size_t& entry = of_blocks[block * count() + bucket];
        const std::size_t found = entry;
        entry = total;
        total += found;
      }
    }
    begins_.push_back(total);
  }

  int bits_;
  std::vector<IdPlace> sorted_;
  std::vector<std::size_t> begins_;
};

// As few as keep a bucket to some ten thousand particles.
int bucket_bits(std::size_t particles) {
  int bits = 0;
  while (bits < 12 && (particles >> bits) > 16384)
    ++bits;
  return bits;
}

std::size_t run_length(const IdPlace* from, const IdPlace* end) {
  const IdPlace* last = from + 1;
  while (last < end && last->id == from->id)
    ++last;
  return static_cast<std::size_t>(last - from);
}

struct MatchedCounts {
  std::size_t in_common = 0, ambiguous = 0;
};

// Writes to each particle's own places alone.
MatchedCounts match_bucket(Buckets::Range a, Buckets::Range b, std::uint32_t* place_in_second,
                           std::uint8_t* appears) {
  MatchedCounts counts;
  while (a.begin < a.end || b.begin < b.end) {
    const bool takes_a = b.begin == b.end || (a.begin < a.end && a.begin->id <= b.begin->id);
    const bool takes_b = a.begin == a.end || (b.begin < b.end && b.begin->id <= a.begin->id);
    const std::size_t of_a = takes_a ? run_length(a.begin, a.end) : 0;
    const std::size_t of_b = takes_b ? run_length(b.begin, b.end) : 0;
    if (of_a == 1 && of_b == 1) {
      place_in_second[a.begin->place] = b.begin->place;
      ++counts.in_common;
    } else {
      for (std::size_t k = 0; k < of_b; ++k)
        appears[b.begin[k].place] = 1;
      counts.ambiguous += (of_a > 1 ? of_a : 0) + (of_b > 1 ? of_b : 0);
    }
    a.begin += of_a;
    b.begin += of_b;
  }
  return counts;
}

std::vector<std::uint32_t> places_of(const std::vector<std::uint8_t>& flags) {
  std::vector<std::uint32_t> places;
  for (std::size_t i = 0; i < flags.size(); ++i) {
    if (flags[i]) places.push_back(static_cast<std::uint32_t>(i));
  }
  return places;
}

}  // namespace

IdMatch match_ids(const Ids& first, const Ids& second) {
  if (std::max(first.size(), second.size()) >= IdMatch::nobody) {
    throw DataError(
        "snapshots are matched for up to 4 billion particles of a type; set time.interpolation to "
        "\"none\"");
  }
  const int bits = bucket_bits(std::max(first.size(), second.size()));
  Buckets a(first, bits), b(second, bits);
  IdMatch match;
  match.place_in_second.assign(first.size(), IdMatch::nobody);
  std::vector<std::uint8_t> appears(second.size(), 0);
  std::atomic<std::size_t> in_common{0}, ambiguous{0};
  for_blocks(a.count(), 1, [&](std::size_t bucket, std::size_t) {
    const MatchedCounts counts =
        match_bucket(a.sort(bucket), b.sort(bucket), match.place_in_second.data(), appears.data());
    in_common += counts.in_common;
    ambiguous += counts.ambiguous;
  });
  match.in_common = in_common;
  match.ambiguous = ambiguous;
  match.appearing = places_of(appears);
  return match;
}

namespace {

struct Members {
  std::uint32_t in_first, in_second;  // places, or nobody
};

Members members_of(const IdMatch& match, std::size_t particle) {
  const std::size_t in_first = match.place_in_second.size();
  if (particle >= in_first) return {IdMatch::nobody, match.appearing[particle - in_first]};
  return {static_cast<std::uint32_t>(particle), match.place_in_second[particle]};
}

float mean_of(float a, float b, float fraction) {
  return a == b ? a : a + fraction * (b - a);
}

// A number as m 2^e with m from sqrt(1/2) to sqrt(2).
struct Octaves {
  explicit Octaves(float value) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    const auto from_root = static_cast<std::int32_t>(bits - 0x3f3504f3u);
    exponent = from_root >> 23;
    const std::uint32_t rest = (static_cast<std::uint32_t>(from_root) & 0x007fffffu) + 0x3f3504f3u;
    std::memcpy(&mantissa, &rest, sizeof mantissa);
  }
  std::int32_t exponent = 0;
  float mantissa = 1;
};

// log2(m), sqrt(1/2) <= m <= sqrt(2): minimax, to 2e-8 beside roundings.
float log2_of_mantissa(float m) {
  const float x = m - 1.0F;
  float p = 0.1292618F;
  p = p * x - 0.20893268F;
  p = p * x + 0.21521264F;
  p = p * x - 0.23867586F;
  p = p * x + 0.28793907F;
  p = p * x - 0.36071625F;
  p = p * x + 0.48091027F;
  p = p * x - 0.7213472F;
  p = p * x + 1.442695F;
  return p * x;
}

// 2^x, -1/2 <= x <= 1/2: minimax, to 1e-8 beside roundings.
float exp2_of_rest(float x) {
  float p = 0.00015469728F;
  p = p * x + 0.0013390867F;
  p = p * x + 0.009618031F;
  p = p * x + 0.05550357F;
  p = p * x + 0.2402265F;
  p = p * x + 0.6931472F;
  return p * x + 1.0F;
}

// -126 <= exponent <= 127.
float power_of_two(std::int32_t exponent) {
  const auto bits = static_cast<std::uint32_t>(exponent + 127) << 23;
  float value = 0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

bool is_normal_and_positive(float value) {
  return value >= std::numeric_limits<float>::min() && value <= std::numeric_limits<float>::max();
}

float geometric_mean_of(float a, float b, float fraction) {
  if (!is_normal_and_positive(a) || !is_normal_and_positive(b)) return mean_of(a, b, fraction);
  if (a == b) return a;
  const Octaves from(a), to(b);
  const float octaves =
      fraction * static_cast<float>(to.exponent - from.exponent) +
      fraction * (log2_of_mantissa(to.mantissa) - log2_of_mantissa(from.mantissa));
  const float whole = std::floor(octaves + 0.5F);
  const auto steps = static_cast<std::int32_t>(whole);
  // In two steps: their product may be no number by itself.
  const std::int32_t half = steps >> 1;
  const float mean =
      (a * exp2_of_rest(octaves - whole)) * power_of_two(half) * power_of_two(steps - half);
  return std::min(std::max(mean, std::min(a, b)), std::max(a, b));
}

float value_between(const ColumnBetween& column, Members of, std::size_t component) {
  const auto width = static_cast<std::size_t>(column.values_per_particle);
  if (of.in_first == IdMatch::nobody) {
    const float value = column.second[of.in_second * width + component];
    return column.fades ? value * column.appearing : value;
  }
  const float a = column.first[of.in_first * width + component];
  if (of.in_second == IdMatch::nobody) return column.fades ? a * column.vanishing : a;
  const float b = column.second[of.in_second * width + component];
  return column.kind == ColumnBetween::Kind::logarithmic ? geometric_mean_of(a, b, column.fraction)
                                                         : mean_of(a, b, column.fraction);
}

float periods_in(float way, int axis, const PathNumbers& path) {
  return std::floor(way * path.inverse_size[axis] + 0.5F);
}

float less_periods(float x, float periods, int axis, const PathNumbers& path) {
  return (x - periods * path.size_high[axis]) - periods * path.size_low[axis];
}

// Only what has left the period is moved, so that nothing else is rounded.
float wrapped(float x, int axis, const PathNumbers& path) {
  if (!path.is_periodic || (x >= path.lower[axis] && x < path.upper[axis])) return x;
  const float periods = std::floor((x - path.lower[axis]) * path.inverse_size[axis]);
  return less_periods(x, periods, axis, path);
}

float tangent(const Column& velocity, std::size_t place, int axis, float rate) {
  if (velocity.is_absent()) return 0;
  return velocity[3 * place + static_cast<std::size_t>(axis)] * rate;
}

float position_between(const ColumnBetween& column, Members of, int axis) {
  const PathNumbers& path = column.path;
  const auto coordinate = [axis](const Column& position, std::size_t place) {
    return position[3 * place + static_cast<std::size_t>(axis)];
  };
  if (of.in_first == IdMatch::nobody) {
    const float x =
        (coordinate(column.second, of.in_second) + path.shift_high[axis]) + path.shift_low[axis];
    const float m = tangent(column.second_velocity, of.in_second, axis, path.second_rate);
    return wrapped(x + path.from_second * m, axis, path);
  }
  const float x = coordinate(column.first, of.in_first);
  const float m = tangent(column.first_velocity, of.in_first, axis, path.first_rate);
  if (of.in_second == IdMatch::nobody) return wrapped(x + path.from_first * m, axis, path);
  float way = ((coordinate(column.second, of.in_second) - x) + path.shift_high[axis]) +
              path.shift_low[axis];
  if (path.is_periodic) way = less_periods(way, periods_in(way, axis, path), axis, path);
  if (path.is_straight) return wrapped(x + column.fraction * way, axis, path);
  const float n = tangent(column.second_velocity, of.in_second, axis, path.second_rate);
  const float moved = (path.of_way * way + path.of_first_tangent * m) + path.of_second_tangent * n;
  return wrapped(x + moved, axis, path);
}

void set_period(const PathSetting& setting, PathNumbers& path) {
  if (!setting.period) return;
  path.is_periodic = true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double size = setting.period->size[axis];
    path.size_high[axis] = static_cast<float>(size);
    path.size_low[axis] = static_cast<float>(size - static_cast<double>(path.size_high[axis]));
    path.inverse_size[axis] = static_cast<float>(1 / size);
    const double lower = setting.period->lower.a[axis] - setting.first_origin.a[axis];
    path.lower[axis] = static_cast<float>(lower);
    path.upper[axis] = static_cast<float>(lower + size);
  }
}

}  // namespace

PathNumbers make_path_numbers(const PathSetting& setting, double f) {
  PathNumbers path;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double shift = setting.second_origin.a[axis] - setting.first_origin.a[axis];
    path.shift_high[axis] = static_cast<float>(shift);
    path.shift_low[axis] = static_cast<float>(shift - static_cast<double>(path.shift_high[axis]));
  }
  set_period(setting, path);
  path.first_rate = static_cast<float>(setting.first_rate);
  path.second_rate = static_cast<float>(setting.second_rate);
  path.is_straight = setting.is_straight;
  path.of_way = static_cast<float>(f * f * (3 - 2 * f));
  path.of_first_tangent = static_cast<float>(f * (1 - f) * (1 - f));
  path.of_second_tangent = static_cast<float>(f * f * (f - 1));
  path.from_first = static_cast<float>(f);
  path.from_second = static_cast<float>(f - 1);
  return path;
}

void interpolate(const ColumnBetween& column, std::size_t begin, std::size_t end, float* values) {
  const auto width = static_cast<std::size_t>(column.values_per_particle);
  const bool is_position = column.kind == ColumnBetween::Kind::position;
  for (std::size_t i = begin; i < end; ++i) {
    const Members of = members_of(*column.match, i / width);
    const std::size_t component = i % width;
    values[i - begin] = is_position ? position_between(column, of, static_cast<int>(component))
                                    : value_between(column, of, component);
  }
}

namespace {

constexpr std::size_t values_per_block = 49152;

// Where particles fade, what they fade with their values.
std::optional<ColumnBetween> fading(const ColumnBetween& column, const ColumnBetween& fade) {
  const bool is_alike = column.match == fade.match && column.fraction == fade.fraction &&
                        column.kind != ColumnBetween::Kind::position && !column.fades;
  if (!is_alike) return std::nullopt;
  ColumnBetween both = column;
  both.fades = true;
  both.vanishing = fade.vanishing;
  both.appearing = fade.appearing;
  return both;
}

// The factor is its own values' alone: 1 for those that stay.
bool only_fades(const ColumnBetween& column) {
  const auto is_one = [](const Column& c) { return c.is_uniform() && c.uniform_value() == 1; };
  return column.fades && is_one(column.first) && is_one(column.second);
}

}  // namespace

std::size_t InterpolatedColumn::size() const {
  return interpolation_.match->particles() *
         static_cast<std::size_t>(interpolation_.values_per_particle);
}

void InterpolatedColumn::make(std::size_t begin, std::size_t end, float* values) const {
  interpolate(interpolation_, begin, end, values);
}

Column InterpolatedColumn::make_all() const {
  std::vector<float> values(size());
  for_blocks(values.size(), values_per_block,
             [&](std::size_t begin, std::size_t end) { make(begin, end, values.data() + begin); });
  return Column::owning(std::move(values));
}

Column column_between(ColumnBetween interpolation) {
  const Column &a = interpolation.first, &b = interpolation.second;
  const bool is_one_value = a.is_uniform() && b.is_uniform() &&
                            a.uniform_value() == b.uniform_value() && !interpolation.fades;
  if (is_one_value) return a;
  return Column::made_by(std::make_shared<const InterpolatedColumn>(std::move(interpolation)));
}

std::shared_ptr<const InterpolatedColumn> interpolated(const Column& column) {
  return std::dynamic_pointer_cast<const InterpolatedColumn>(column.source());
}

Column faded(const Column& column, const Column& fade, std::size_t count) {
  const auto fades = interpolated(fade);
  if (fades && only_fades(fades->interpolation())) {
    if (!column.is_array()) {
      ColumnBetween both = fades->interpolation();
      both.first = both.second = Column::uniform(column.is_absent() ? 1 : column.uniform_value());
      return column_between(std::move(both));
    }
    if (const auto values = interpolated(column)) {
      auto both = fading(values->interpolation(), fades->interpolation());
      if (both) return column_between(std::move(*both));
    }
  }
  std::vector<float> product(count);
  for (std::size_t i = 0; i < count; ++i)
    product[i] = fade[i] * (column.is_absent() ? 1 : column[i]);
  return Column::owning(std::move(product));
}

}  // namespace splotchcl
