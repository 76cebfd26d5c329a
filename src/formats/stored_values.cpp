#include "formats/stored_values.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#include "parallel/available_memory.h"
#include "parallel/for_blocks.h"
#include "scene/memory_advice.h"
#include "scene/particle_columns.h"

namespace splotchcl {
namespace {

struct SixBytes {};  // stands for uint48 where a type is asked for
struct HalfFloat {};

float float_of_half(std::uint16_t bits) {
  const int exponent = (bits >> 10) & 31, fraction = bits & 1023;
  const float sign = (bits >> 15) != 0 ? -1.0F : 1.0F;
  if (exponent == 31) {
    return fraction == 0 ? sign * std::numeric_limits<float>::infinity()
                         : std::numeric_limits<float>::quiet_NaN();
  }
  const bool is_subnormal = exponent == 0;
  const int mantissa = is_subnormal ? fraction : fraction + 1024;
  return sign * std::ldexp(static_cast<float>(mantissa), (is_subnormal ? 1 : exponent) - 25);
}

template <typename T>
T load_as(const std::byte* bytes, bool is_swapped) {
  std::byte copy[sizeof(T)];
  std::memcpy(copy, bytes, sizeof copy);
  if (is_swapped) std::reverse(copy, copy + sizeof copy);
  T value;
  std::memcpy(&value, copy, sizeof value);
  return value;
}

template <typename T>
auto load(const std::byte* bytes, bool is_swapped) {
  if constexpr (std::is_same_v<T, SixBytes>) {
    std::byte wide[8] = {};
    const bool is_big = is_swapped == is_little_endian_host();
    std::memcpy(is_big ? wide + 2 : wide, bytes, 6);
    return load_as<std::uint64_t>(wide, is_swapped);
  } else if constexpr (std::is_same_v<T, HalfFloat>) {
    return float_of_half(load_as<std::uint16_t>(bytes, is_swapped));
  } else {
    return load_as<T>(bytes, is_swapped);
  }
}

// Calls `use` with a null pointer of the type that `kind` stands for.
template <typename Use>
auto with_value_type(ValueKind kind, Use&& use) {
  switch (kind) {
    case ValueKind::float16:
      return use(static_cast<const HalfFloat*>(nullptr));
    case ValueKind::float32:
      return use(static_cast<const float*>(nullptr));
    case ValueKind::float64:
      return use(static_cast<const double*>(nullptr));
    case ValueKind::int8:
      return use(static_cast<const std::int8_t*>(nullptr));
    case ValueKind::int16:
      return use(static_cast<const std::int16_t*>(nullptr));
    case ValueKind::int32:
      return use(static_cast<const std::int32_t*>(nullptr));
    case ValueKind::int64:
      return use(static_cast<const std::int64_t*>(nullptr));
    case ValueKind::uint8:
      return use(static_cast<const std::uint8_t*>(nullptr));
    case ValueKind::uint16:
      return use(static_cast<const std::uint16_t*>(nullptr));
    case ValueKind::uint32:
      return use(static_cast<const std::uint32_t*>(nullptr));
    case ValueKind::uint48:
      return use(static_cast<const SixBytes*>(nullptr));
    case ValueKind::uint64:
      break;
  }
  return use(static_cast<const std::uint64_t*>(nullptr));
}

std::uint64_t stride_of(const StoredValues& part) {
  return part.stride != 0 ? part.stride : part.packed_bytes_per_particle();
}

std::uint64_t axis_stride_of(const StoredValues& part) {
  return part.axis_stride != 0 ? part.axis_stride : size_of(part.kind);
}

constexpr Vec3 zero = {{0, 0, 0}};

bool can_point_into_file(const StoredValues& part) {
  const std::byte* const first = part.file->data() + part.offset;
  return part.kind == ValueKind::float32 && !part.is_swapped &&
         stride_of(part) == part.packed_bytes_per_particle() &&
         axis_stride_of(part) == sizeof(float) &&
         reinterpret_cast<std::uintptr_t>(first) % alignof(float) == 0;
}

std::size_t number_of_values(const StoredValues& part) {
  return part.particles * static_cast<std::size_t>(part.values_per_particle);
}

// Values [begin, end) of a part.
template <typename T>
float* convert_as(const StoredValues& part, const Vec3& origin, std::size_t begin, std::size_t end,
                  float* out) {
  const auto width = static_cast<std::size_t>(part.values_per_particle);
  const bool has_origin = width == 3 && origin != zero;
  const std::uint64_t stride = stride_of(part), axis_stride = axis_stride_of(part);
  std::size_t axis = begin % width;
  const std::byte* particle = part.file->data() + part.offset + begin / width * stride;
  for (std::size_t i = begin; i < end; ++i) {
    const auto value = load<T>(particle + axis * axis_stride, part.is_swapped);
    *out++ = has_origin ? static_cast<float>(static_cast<double>(value) - origin.a[axis])
                        : static_cast<float>(value);
    if (++axis == width) {
      axis = 0;
      particle += stride;
    }
  }
  return out;
}

float* convert(const StoredValues& part, const Vec3& origin, std::size_t begin, std::size_t end,
               float* out) {
  if (can_point_into_file(part) && origin == zero) {
    std::memcpy(out, part.file->data() + part.offset + begin * sizeof(float),
                (end - begin) * sizeof(float));
    return out + (end - begin);
  }
  return with_value_type(part.kind, [&](auto* type) {
    using T = std::remove_cv_t<std::remove_pointer_t<decltype(type)>>;
    return convert_as<T>(part, origin, begin, end, out);
  });
}

// The values of files that are mapped, one file after the other.
struct StoredColumn {
  std::vector<StoredValues> parts;  // none of them empty
  std::vector<std::size_t> ends;    // behind each part's values
  Vec3 origin;

  std::size_t size() const { return ends.empty() ? 0 : ends.back(); }

  void make(std::size_t begin, std::size_t end, float* out) const {
    // Single values are asked for, too, of snapshots of many files.
    auto part =
        static_cast<std::size_t>(std::upper_bound(ends.begin(), ends.end(), begin) - ends.begin());
    while (begin < end) {
      const std::size_t first = part == 0 ? 0 : ends[part - 1];
      const std::size_t to = std::min(end, ends[part]);
      out = convert(parts[part], origin, begin - first, to - first, out);
      begin = to;
      ++part;
    }
  }
};

StoredColumn stored_column(const std::vector<StoredValues>& parts, const Vec3& origin) {
  StoredColumn column;
  column.origin = origin;
  for (const StoredValues& part : parts) {
    if (part.particles == 0) continue;
    part.file->check_size();
    column.parts.push_back(part);
    column.ends.push_back(column.size() + number_of_values(part));
  }
  return column;
}

// A part that already is what is wanted.
std::optional<Column> in_place(const StoredColumn& column) {
  if (column.parts.size() != 1 || column.origin != zero) return std::nullopt;
  const StoredValues& part = column.parts.front();
  if (!can_point_into_file(part)) return std::nullopt;
  const std::byte* const first = part.file->data() + part.offset;
  return Column(part.file, reinterpret_cast<const float*>(first), column.size());
}

// As it is, file after file.
bool lies_in_files(const StoredColumn& column) {
  return column.origin == zero &&
         std::all_of(column.parts.begin(), column.parts.end(), can_point_into_file);
}

// Files that hold what is wanted, one after the other: a copy would serve frames that follow, and
// make the first wait.
bool is_better_left(const StoredColumn& column) {
  constexpr std::size_t most_copied_bytes = std::size_t{256} << 20;
  return column.size() * sizeof(float) > most_copied_bytes && lies_in_files(column);
}

Column copied(const StoredColumn& column) {
  constexpr std::size_t values_at_once = std::size_t{1} << 20;
  LargeVector<float> values(column.size());
  for_blocks(values.size(), values_at_once, [&](std::size_t first, std::size_t last) {
    column.make(first, last, values.data() + first);
  });
  return owning_column(std::move(values));
}

// A frame that is drawn of a tree looks at few of them.
class CopyOfFiles final : public ColumnSource {
 public:
  explicit CopyOfFiles(StoredColumn column) : column_(std::move(column)) {}
  std::size_t size() const override { return column_.size(); }
  bool is_copy() const override { return true; }
  void make(std::size_t begin, std::size_t end, float* values) const override {
    column_.make(begin, end, values);
  }
  Column make_all() const override { return copied(column_); }

 private:
  StoredColumn column_;
};

Column converted(StoredColumn column, bool is_streamed) {
  const std::size_t size = column.size();
  if (is_streamed) {
    return make_column(
        size, true, [column = std::move(column)](std::size_t begin, std::size_t end, float* out) {
          column.make(begin, end, out);
        });
  }
  if (lies_in_files(column))
    return Column::made_by(std::make_shared<const CopyOfFiles>(std::move(column)));
  return copied(column);
}

}  // namespace

bool is_little_endian_host() {
  const std::uint16_t one = 1;
  unsigned char first = 0;
  std::memcpy(&first, &one, 1);
  return first == 1;
}

double value_at(const StoredValues& values, std::uint64_t particle, int axis) {
  const std::byte* const bytes = values.file->data() + values.offset +
                                 particle * stride_of(values) +
                                 static_cast<std::uint64_t>(axis) * axis_stride_of(values);
  return with_value_type(values.kind, [&](auto* type) {
    using T = std::remove_cv_t<std::remove_pointer_t<decltype(type)>>;
    return static_cast<double>(load<T>(bytes, values.is_swapped));
  });
}

double number_at(const std::shared_ptr<const MappedFile>& file, std::uint64_t offset,
                 ValueKind kind, bool is_swapped) {
  return value_at(StoredValues{file, offset, 1, 1, 0, kind, is_swapped, 0}, 0, 0);
}

Column make_column(const std::vector<StoredValues>& parts, const Vec3& origin) {
  StoredColumn column = stored_column(parts, origin);
  if (const auto mapped = in_place(column)) return *mapped;
  const bool is_streamed =
      is_too_large_to_copy(column.size() * sizeof(float)) || is_better_left(column);
  return converted(std::move(column), is_streamed);
}

Column make_streamed_column(const std::vector<StoredValues>& parts, const Vec3& origin) {
  StoredColumn column = stored_column(parts, origin);
  if (const auto mapped = in_place(column)) return *mapped;
  return converted(std::move(column), true);
}

namespace {

// Up to which a kind of floats has all whole numbers; 0: it is none.
double largest_whole(ValueKind kind) {
  if (kind == ValueKind::float16) return 2048;
  if (kind == ValueKind::float32) return 16777216;
  return kind == ValueKind::float64 ? 9007199254740992 : 0;
}

// False for others.
bool append_whole_floats(const StoredValues& part, double largest,
                         std::vector<std::uint64_t>& values) {
  for (std::uint64_t i = 0; i < part.particles; ++i) {
    const double value = value_at(part, i, 0);
    if (!(value >= 0 && value <= largest && value == std::floor(value))) return false;
    values.push_back(static_cast<std::uint64_t>(value));
  }
  return true;
}

}  // namespace

std::optional<std::vector<std::uint64_t>> make_integers(const std::vector<StoredValues>& parts) {
  std::vector<std::uint64_t> values;
  for (const StoredValues& part : parts) {
    if (part.values_per_particle != 1) return std::nullopt;
    part.file->check_size();
    if (const double largest = largest_whole(part.kind); largest > 0) {
      if (!append_whole_floats(part, largest, values)) return std::nullopt;
      continue;
    }
    const std::byte* particle = part.file->data() + part.offset;
    with_value_type(part.kind, [&](auto* type) {
      using T = std::remove_cv_t<std::remove_pointer_t<decltype(type)>>;
      for (std::uint64_t i = 0; i < part.particles; ++i, particle += stride_of(part)) {
        values.push_back(static_cast<std::uint64_t>(load<T>(particle, part.is_swapped)));
      }
    });
  }
  return values;
}

namespace {

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

std::vector<SampleRange> sample_ranges(const std::vector<std::uint64_t>& part_sizes) {
  constexpr std::uint64_t runs = 64, run_length = 64;  // few places: compressed data is costly
  std::vector<std::uint64_t> starts = {0};             // of each part among all particles
  for (const std::uint64_t size : part_sizes)
    starts.push_back(starts.back() + size);
  const std::uint64_t total = starts.back();
  const std::uint64_t step = std::max(run_length, total / runs);
  std::vector<SampleRange> ranges;
  std::size_t part = 0;
  for (std::uint64_t run = 0; run < total; run += step) {
    const std::uint64_t end = std::min(run + run_length, total);
    for (std::uint64_t at = run; at < end;) {
      while (starts[part + 1] <= at)
        ++part;
      const std::uint64_t last = std::min(end, starts[part + 1]);
      ranges.push_back({part, at - starts[part], last - at});
      at = last;
    }
  }
  return ranges;
}

Vec3 choose_position_origin(const std::vector<std::array<double, 3>>& sample) {
  Vec3 origin = {{0, 0, 0}};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const auto& position : sample) {
      const auto rounded = static_cast<double>(static_cast<float>(position[axis]));
      if (std::isfinite(rounded)) values.push_back(rounded);
    }
    origin.a[axis] = median(std::move(values));
  }
  return origin;
}

}  // namespace splotchcl
