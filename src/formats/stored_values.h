#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "common/mapped_file.h"
#include "splotchcl/particles.h"
#include "splotchcl/vector.h"

namespace splotchcl {

// uint48: six bytes, as some codes store identifiers.
enum class ValueKind {
  float16,
  float32,
  float64,
  int8,
  int16,
  int32,
  int64,
  uint8,
  uint16,
  uint32,
  uint48,
  uint64
};
constexpr std::size_t size_of(ValueKind kind) {
  switch (kind) {
    case ValueKind::int8:
    case ValueKind::uint8:
      return 1;
    case ValueKind::float16:
    case ValueKind::int16:
    case ValueKind::uint16:
      return 2;
    case ValueKind::float32:
    case ValueKind::int32:
    case ValueKind::uint32:
      return 4;
    case ValueKind::uint48:
      return 6;
    case ValueKind::float64:
    case ValueKind::int64:
    case ValueKind::uint64:
      break;
  }
  return 8;
}

// Whether single precision has every value of the kind.
constexpr bool holds_single_precision(ValueKind kind) {
  return kind == ValueKind::float32 || size_of(kind) <= 2;
}

// One quantity of `particles` particles as it lies in a mapped file.
struct StoredValues {
  std::shared_ptr<const MappedFile> file;
  std::uint64_t offset = 0;  // of the first particle's first value, in bytes
  std::uint64_t particles = 0;
  int values_per_particle = 1;
  std::uint64_t stride = 0;  // bytes from particle to particle; 0: without gaps
  ValueKind kind = ValueKind::float32;
  bool is_swapped = false;        // the other endianness than this machine's
  std::uint64_t axis_stride = 0;  // bytes from value to value of a particle; 0: without gaps

  std::uint64_t packed_bytes_per_particle() const {
    return static_cast<std::uint64_t>(values_per_particle) * size_of(kind);
  }
};

// The parts one after the other, in single precision. A single part of native float32,
// 4-byte aligned, is not copied: the column points into the file. `origin` is taken from
// 3-vectors in double before they are rounded. What would be too large to copy is converted as it
// is wanted.
Column make_column(const std::vector<StoredValues>& parts, const Vec3& origin = {{0, 0, 0}});
// The same, converted as it is wanted unless it points into the file.
Column make_streamed_column(const std::vector<StoredValues>& parts,
                            const Vec3& origin = {{0, 0, 0}});

// Whole numbers, exact, the parts one after the other; empty when a part holds none. Floats that
// are whole numbers count, as far as their precision has all of these.
std::optional<std::vector<std::uint64_t>> make_integers(const std::vector<StoredValues>& parts);

// One value in double; `particle` and `axis` must exist.
double value_at(const StoredValues& values, std::uint64_t particle, int axis);

// The number at a place in a file, in double; it must lie inside.
double number_at(const std::shared_ptr<const MappedFile>& file, std::uint64_t offset,
                 ValueKind kind, bool is_swapped);

// Whether this machine stores the lowest byte first.
bool is_little_endian_host();

// Consecutive particles of one part of a snapshot.
struct SampleRange {
  std::size_t part = 0;
  std::uint64_t first = 0;
  std::uint64_t count = 0;
};

// The particles from which an origin is chosen, some thousands evenly over all. The parts
// are the types' particles in each file, in the order of types and then of files: so the
// same state gives the same sample in any format and in any number of files.
std::vector<SampleRange> sample_ranges(const std::vector<std::uint64_t>& part_sizes);

// The origin from which double-precision positions become single-precision offsets: the
// median of a sample per axis, rounded to single precision. In a zoom simulation most
// particles are in the object of interest, so offsets are smallest, and finest, there.
Vec3 choose_position_origin(const std::vector<std::array<double, 3>>& sample);

}  // namespace splotchcl
