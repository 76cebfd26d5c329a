#include "formats/hdf5/hdf5_column.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/mapped_file.h"
#include "formats/position_origin.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

std::size_t number_of_values(const Hdf5Values& part) {
  return part.dataset.rows() * part.dataset.values_per_row();
}

// Empty unless the values lie in the file as they are needed.
Column map_column(const Hdf5Values& part, const Hdf5File& file) {
  const auto offset = file.native_float_offset(part.dataset);
  if (!offset) return {};
  auto mapped = MappedFile::open(part.file);
  const std::size_t values = number_of_values(part);
  const bool is_inside =
      *offset <= mapped->size() && values <= (mapped->size() - *offset) / sizeof(float);
  const std::byte* const first = mapped->data() + *offset;
  if (!is_inside || reinterpret_cast<std::uintptr_t>(first) % alignof(float) != 0) return {};
  return Column(mapped, reinterpret_cast<const float*>(first), values);
}

// Calls use(first row, rows) for large pieces of the dataset.
template <typename Use>
void for_pieces(const Hdf5File& file, const Hdf5Dataset& dataset, Use&& use) {
  const std::uint64_t piece = file.rows_per_piece(dataset);
  for (std::uint64_t first = 0; first < dataset.rows(); first += piece) {
    use(first, std::min(piece, dataset.rows() - first));
  }
}

void read_as_stored(const Hdf5File& file, const Hdf5Dataset& dataset, float* out) {
  for_pieces(file, dataset, [&](std::uint64_t first, std::uint64_t rows) {
    file.read_rows(dataset, first, rows, out + first * dataset.values_per_row());
  });
}

void read_changed(const Hdf5File& file, const Hdf5Dataset& dataset, const Vec3& origin,
                  double factor, float* out) {
  const std::size_t width = dataset.values_per_row();
  std::vector<double> buffer;
  for_pieces(file, dataset, [&](std::uint64_t first, std::uint64_t rows) {
    buffer.resize(rows * width);
    file.read_rows(dataset, first, rows, buffer.data());
    for (std::size_t i = 0; i < buffer.size(); ++i) {
      const double zero = width == 3 ? origin.a[i % 3] : 0;
      out[first * width + i] = static_cast<float>((buffer[i] - zero) * factor);
    }
  });
}

bool is_double(const Hdf5Values& part) {
  return part.dataset.kind == Hdf5Dataset::Kind::real && part.dataset.bytes_per_value > 4;
}

}  // namespace

Column read_column(const std::vector<Hdf5Values>& parts, const Vec3& origin, double factor) {
  const bool is_as_stored = origin == Vec3{{0, 0, 0}} && factor == 1;
  std::size_t size = 0;
  // Before any memory is claimed, all of it must be there.
  for (const Hdf5Values& part : parts) {
    Hdf5File(part.file).check_complete(part.dataset);
    size += number_of_values(part);
  }
  if (parts.size() == 1 && is_as_stored) {
    Column column = map_column(parts[0], Hdf5File(parts[0].file));
    if (!column.is_absent()) return column;
  }
  std::vector<float> values(size);
  float* out = values.data();
  for (const Hdf5Values& part : parts) {
    const Hdf5File file(part.file);
    if (is_as_stored) {
      read_as_stored(file, part.dataset, out);
    } else {
      read_changed(file, part.dataset, origin, factor, out);
    }
    out += number_of_values(part);
  }
  return Column::owning(std::move(values));
}

std::optional<std::vector<std::uint64_t>> read_integers(const std::vector<Hdf5Values>& parts) {
  std::vector<std::uint64_t> values;
  for (const Hdf5Values& part : parts) {
    const Hdf5File file(part.file);
    file.check_complete(part.dataset);
    const bool is_integer = part.dataset.kind == Hdf5Dataset::Kind::integer;
    if (!is_integer || part.dataset.values_per_row() != 1) return std::nullopt;
    const std::size_t before = values.size();
    values.resize(before + part.dataset.rows());
    for_pieces(file, part.dataset, [&](std::uint64_t first, std::uint64_t rows) {
      file.read_rows(part.dataset, first, rows, values.data() + before + first);
    });
  }
  return values;
}

Vec3 find_position_origin(const std::vector<Hdf5Values>& positions) {
  if (std::none_of(positions.begin(), positions.end(), is_double)) return {{0, 0, 0}};
  std::vector<std::uint64_t> sizes;
  for (const Hdf5Values& part : positions) {
    Hdf5File(part.file).check_complete(part.dataset);
    sizes.push_back(part.dataset.rows());
  }
  std::vector<std::array<double, 3>> sample;
  for (const SampleRange& range : sample_ranges(sizes)) {
    const Hdf5Values& part = positions[range.part];
    std::vector<double> values(3 * range.count);
    Hdf5File(part.file).read_rows(part.dataset, range.first, range.count, values.data());
    for (std::size_t i = 0; i < range.count; ++i) {
      sample.push_back({values[3 * i], values[3 * i + 1], values[3 * i + 2]});
    }
  }
  return choose_position_origin(sample);
}

}  // namespace splotchcl
