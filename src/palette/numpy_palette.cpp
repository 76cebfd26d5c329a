#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "formats/numpy/numpy_array.h"
#include "palette/other_palettes.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

[[noreturn]] void refuse_array(const std::string& name, const std::string& found) {
  throw DataError(fmt::format(
      "{}: found {}, expected an array of at most {} rows of red, green and blue (and an "
      "opacity of 1), from 0 to 1, or whole numbers to 255",
      name, found, most_knots));
}

bool may_be_colors(const NumpyHeader& header) {
  return !header.is_structured && !header.is_pickled && header.members.front().is_usable &&
         header.shape.size() == 2 && (header.shape[1] == 3 || header.shape[1] == 4) &&
         header.shape[0] > 0 && header.shape[0] <= most_knots;
}

StoredValues values_of(const std::string& bytes, const NumpyHeader& header,
                       const std::string& name) {
  const auto* const first = reinterpret_cast<const std::byte*>(bytes.data());
  const NumpyMember& number = header.members.front();
  StoredValues values;
  values.file = MappedFile::of_bytes(name, {first, first + bytes.size()});
  values.offset = header.data_offset;
  values.particles = header.rows();
  values.values_per_particle = static_cast<int>(header.shape[1]);
  values.kind = number.kind;
  values.is_swapped = number.is_swapped;
  values.stride =
      header.is_fortran_order ? header.record_bytes : header.record_bytes * header.shape[1];
  values.axis_stride =
      header.is_fortran_order ? header.record_bytes * header.rows() : header.record_bytes;
  return values;
}

bool is_float(ValueKind kind) {
  return kind == ValueKind::float16 || kind == ValueKind::float32 || kind == ValueKind::float64;
}

// Whether colors are whole numbers up to 255, also where they are kept as floats.
bool are_bytes(const StoredValues& values) {
  bool is_any_large = !is_float(values.kind);
  for (std::uint64_t row = 0; row < values.particles; ++row) {
    for (int c = 0; c < values.values_per_particle; ++c) {
      const double value = value_at(values, row, c);
      if (value != std::floor(value)) return false;
      is_any_large = is_any_large || value > 1;
    }
  }
  return is_any_large;
}

}  // namespace

std::optional<Palette> read_numpy_palette(const std::string& bytes, const std::string& name) {
  const auto* const first = reinterpret_cast<const std::byte*>(bytes.data());
  if (!is_numpy_array(first, bytes.size())) return std::nullopt;
  const NumpyHeader header = read_numpy_header(first, bytes.size(), bytes.size(), name);
  if (!may_be_colors(header))
    refuse_array(name, fmt::format("an array of the shape {}", fmt::join(header.shape, " x ")));
  const StoredValues values = values_of(bytes, header, name);
  const double white = are_bytes(values) ? 255 : 1;
  Palette palette;
  palette.name = name;
  for (std::uint64_t row = 0; row < header.rows(); ++row) {
    Rgb color;
    for (int c = 0; c < values.values_per_particle; ++c) {
      const double light = value_at(values, row, c) / white;
      const bool is_opacity = c == 3;
      if (!(light >= 0 && light <= 1) || (is_opacity && light != 1))
        refuse_array(name, fmt::format("{} in row {}", light * white, row));
      if (!is_opacity) color[static_cast<std::size_t>(c)] = static_cast<float>(light);
    }
    palette.emission.push_back(color);
  }
  return palette;
}

}  // namespace splotchcl
