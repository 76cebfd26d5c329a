#include "formats/hdf5/hdf5_column.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <utility>

#include "common/mapped_file.h"
#include "formats/stored_values.h"
#include "parallel/available_memory.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

std::size_t number_of_values(const Hdf5Values& part) {
  return part.dataset.rows() * part.dataset.values_per_row();
}

// Empty unless the values lie in a file as they are needed.
Column map_column(const Hdf5Values& part, const Hdf5File& file) {
  const auto place = file.find_native_floats(part.dataset);
  if (!place) return {};
  auto mapped = MappedFile::open(place->file);
  const std::size_t values = number_of_values(part);
  const bool is_inside =
      place->offset <= mapped->size() && values <= (mapped->size() - place->offset) / sizeof(float);
  const std::byte* const first = mapped->data() + place->offset;
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

// Rows of a dataset as values of a column.
struct RowReader {
  Vec3 origin;
  double factor = 1;

  bool is_as_stored() const { return origin == Vec3{{0, 0, 0}} && factor == 1; }

  void read(const Hdf5File& file, const Hdf5Dataset& dataset, std::uint64_t first,
            std::uint64_t rows, float* out) const {
    if (is_as_stored()) {
      file.read_rows(dataset, first, rows, out);
      return;
    }
    const std::size_t width = dataset.values_per_row();
    std::vector<double> values(rows * width);
    file.read_rows(dataset, first, rows, values.data());
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double zero = width == 3 ? origin.a[i % 3] : 0;
      out[i] = static_cast<float>((values[i] - zero) * factor);
    }
  }
};

// The datasets of a set of files, read piece by piece. The last piece is kept: samples ask for
// values one by one, in order.
class StreamedDatasets final : public ColumnSource {
 public:
  StreamedDatasets(std::vector<Hdf5Values> parts, const RowReader& reader)
      : parts_(std::move(parts)), reader_(reader) {
    for (const Hdf5Values& part : parts_)
      size_ += number_of_values(part);
  }
  std::size_t size() const override { return size_; }
  bool is_streamed() const override { return true; }

  void make(std::size_t begin, std::size_t end, float* out) const override {
    // HDF5 serves one thread at a time, whatever is read.
    static std::mutex one_reader;
    const std::lock_guard lock(one_reader);
    while (begin < end) {
      if (begin < piece_begin_ || begin >= piece_begin_ + piece_.size()) read_piece(begin);
      const std::size_t to = std::min(end, piece_begin_ + piece_.size());
      out = std::copy_n(piece_.data() + (begin - piece_begin_), to - begin, out);
      begin = to;
    }
  }

 private:
  // That in which value `wanted` lies.
  void read_piece(std::size_t wanted) const {
    std::size_t first = 0;  // value of the part
    for (const Hdf5Values& part : parts_) {
      const std::size_t count = number_of_values(part);
      if (wanted >= first + count) {
        first += count;
        continue;
      }
      const Hdf5File file(part.file);
      const std::uint64_t rows_of_piece = file.rows_per_piece(part.dataset);
      const std::uint64_t width = part.dataset.values_per_row();
      const std::uint64_t row = (wanted - first) / width / rows_of_piece * rows_of_piece;
      const std::uint64_t rows = std::min(rows_of_piece, part.dataset.rows() - row);
      std::vector<float> values(rows * width);
      reader_.read(file, part.dataset, row, rows, values.data());
      // Both or, where the read throws, neither.
      piece_ = std::move(values);
      piece_begin_ = first + row * width;
      return;
    }
  }

  const std::vector<Hdf5Values> parts_;
  const RowReader reader_;
  std::size_t size_ = 0;
  mutable std::vector<float> piece_;
  mutable std::size_t piece_begin_ = 0;
};

// Values of all parts; before any memory is claimed, all of them must be there.
std::size_t checked_size(const std::vector<Hdf5Values>& parts) {
  std::size_t size = 0;
  for (const Hdf5Values& part : parts) {
    Hdf5File(part.file).check_complete(part.dataset);
    size += number_of_values(part);
  }
  return size;
}

// A single part that lies in its file as it is needed.
std::optional<Column> in_place(const std::vector<Hdf5Values>& parts, const RowReader& reader) {
  if (parts.size() != 1 || !reader.is_as_stored()) return std::nullopt;
  const Column column = map_column(parts[0], Hdf5File(parts[0].file));
  return column.is_absent() ? std::nullopt : std::optional(column);
}

bool is_double(const Hdf5Values& part) {
  return part.dataset.is_double();
}

}  // namespace

Column read_column(const std::vector<Hdf5Values>& parts, const Vec3& origin, double factor) {
  const RowReader reader{origin, factor};
  const std::size_t size = checked_size(parts);
  if (const auto column = in_place(parts, reader)) return *column;
  if (is_too_large_to_copy(size * sizeof(float)))
    return Column::made_by(std::make_shared<StreamedDatasets>(parts, reader));
  std::vector<float> values(size);
  float* out = values.data();
  for (const Hdf5Values& part : parts) {
    const Hdf5File file(part.file);
    for_pieces(file, part.dataset, [&](std::uint64_t first, std::uint64_t rows) {
      reader.read(file, part.dataset, first, rows, out + first * part.dataset.values_per_row());
    });
    out += number_of_values(part);
  }
  return Column::owning(std::move(values));
}

Column read_streamed_column(const std::vector<Hdf5Values>& parts, const Vec3& origin,
                            double factor) {
  const RowReader reader{origin, factor};
  checked_size(parts);
  if (const auto column = in_place(parts, reader)) return *column;
  return Column::made_by(std::make_shared<StreamedDatasets>(parts, reader));
}

namespace {

// Some keep identifiers as floats: whole numbers as far as these have all of them. False for
// others.
bool append_whole_floats(const Hdf5File& file, const Hdf5Dataset& dataset,
                         std::vector<std::uint64_t>& values) {
  const double largest = dataset.is_single_precision() ? 16777216.0 : 9007199254740992.0;
  bool are_whole = true;
  for_pieces(file, dataset, [&](std::uint64_t first, std::uint64_t rows) {
    if (!are_whole) return;
    std::vector<double> found(rows);
    file.read_rows(dataset, first, rows, found.data());
    for (const double value : found) {
      are_whole = are_whole && std::abs(value) <= largest && value == std::floor(value);
      if (!are_whole) return;
      values.push_back(static_cast<std::uint64_t>(static_cast<std::int64_t>(value)));
    }
  });
  return are_whole;
}

}  // namespace

std::optional<std::vector<std::uint64_t>> read_integers(const std::vector<Hdf5Values>& parts) {
  std::vector<std::uint64_t> values;
  for (const Hdf5Values& part : parts) {
    const Hdf5File file(part.file);
    file.check_complete(part.dataset);
    if (!part.dataset.is_number() || part.dataset.values_per_row() != 1) return std::nullopt;
    if (part.dataset.kind == Hdf5Dataset::Kind::real) {
      if (!append_whole_floats(file, part.dataset, values)) return std::nullopt;
      continue;
    }
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
