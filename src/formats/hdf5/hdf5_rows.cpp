// Reading the rows of datasets, and of what is a part of each row.
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "formats/hdf5/hdf5_file.h"

namespace splotchcl {
namespace {

using PropertyList = Hdf5Handle<H5Pclose>;
using Space = Hdf5Handle<H5Sclose>;
using Type = Hdf5Handle<H5Tclose>;

// Of the dataset alone, without that of an array in each record.
std::size_t rank_of(hid_t space) {
  return static_cast<std::size_t>(std::max(H5Sget_simple_extent_ndims(space), 0));
}

// A member's values, of `number` each, as memory without gaps has them.
Type type_of_member(const Hdf5Dataset& dataset, std::size_t rank, hid_t number) {
  const std::vector<hsize_t> array(dataset.shape.begin() + static_cast<std::ptrdiff_t>(rank),
                                   dataset.shape.end());
  Type type(array.empty()
                ? H5Tcopy(number)
                : H5Tarray_create2(number, static_cast<unsigned>(array.size()), array.data()));
  for (auto name = dataset.member.rbegin(); name != dataset.member.rend(); ++name) {
    Type record(H5Tcreate(H5T_COMPOUND, H5Tget_size(type.id())));
    H5Tinsert(record.id(), name->c_str(), 0, type.id());
    type = std::move(record);
  }
  return type;
}

std::size_t axis_of_rows(const Hdf5Dataset& dataset) {
  return dataset.has_axes_first ? 1 : 0;
}

}  // namespace

// All of the rows, in the order in which they are stored.
void Hdf5File::read(const Hdf5Dataset& dataset, std::uint64_t first, std::uint64_t rows, hid_t type,
                    void* out) const {
  const Hdf5Silence silence;
  const Dataset handle = open_dataset(dataset.path);
  const Space file_space(H5Dget_space(handle.id()));
  const std::size_t rank = std::min(rank_of(file_space.id()), dataset.shape.size());
  const Type memory_type = type_of_member(dataset, rank, type);
  if (rank == 0) {  // a single value
    if (H5Dread(handle.id(), memory_type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, out) < 0) {
      fail(fmt::format("dataset {} cannot be read", dataset.name()));
    }
    return;
  }
  std::vector<hsize_t> count(dataset.shape.begin(),
                             dataset.shape.begin() + static_cast<std::ptrdiff_t>(rank));
  std::vector<hsize_t> start(rank, 0);
  start[axis_of_rows(dataset)] = first;
  count[axis_of_rows(dataset)] = rows;
  const Space memory(H5Screate_simple(static_cast<int>(rank), count.data(), nullptr));
  const bool is_read =
      H5Sselect_hyperslab(file_space.id(), H5S_SELECT_SET, start.data(), nullptr, count.data(),
                          nullptr) >= 0 &&
      H5Dread(handle.id(), memory_type.id(), memory.id(), file_space.id(), H5P_DEFAULT, out) >= 0;
  if (!is_read) fail(fmt::format("dataset {} cannot be read", dataset.name()));
}

// What counts of the rows, row by row.
template <class T>
void Hdf5File::read_parts(const Hdf5Dataset& dataset, std::uint64_t first, std::uint64_t rows,
                          hid_t type, T* out) const {
  if (!dataset.has_axes_first && !dataset.column) return read(dataset, first, rows, type, out);
  const std::uint64_t width = dataset.stored_values_per_row();
  std::vector<T> stored(rows * width);
  read(dataset, first, rows, type, stored.data());
  const std::uint64_t step = dataset.has_axes_first ? rows : 1;
  const std::uint64_t next_row = dataset.has_axes_first ? 1 : width;
  for (std::uint64_t row = 0; row < rows; ++row) {
    for (std::uint64_t value = 0; value < dataset.values_per_row(); ++value)
      *out++ = stored[row * next_row + dataset.column.value_or(value) * step];
  }
}

void Hdf5File::read_rows(const Hdf5Dataset& dataset, std::uint64_t first, std::uint64_t rows,
                         float* out) const {
  read_parts(dataset, first, rows, H5T_NATIVE_FLOAT, out);
}

void Hdf5File::read_rows(const Hdf5Dataset& dataset, std::uint64_t first, std::uint64_t rows,
                         double* out) const {
  read_parts(dataset, first, rows, H5T_NATIVE_DOUBLE, out);
}

void Hdf5File::read_rows(const Hdf5Dataset& dataset, std::uint64_t first, std::uint64_t rows,
                         std::uint64_t* out) const {
  // HDF5 would make 0 of all below it.
  read_parts(dataset, first, rows, dataset.is_signed ? H5T_NATIVE_INT64 : H5T_NATIVE_UINT64, out);
}

std::uint64_t Hdf5File::rows_per_piece(const Hdf5Dataset& dataset) const {
  constexpr std::uint64_t values_in_piece = 1U << 22, most_rows = 1U << 20;
  const std::uint64_t width = std::max<std::uint64_t>(1, dataset.stored_values_per_row());
  const std::uint64_t piece =
      std::max<std::uint64_t>(1, std::min(most_rows, values_in_piece / width));
  const Hdf5Silence silence;
  const Dataset handle = open_dataset(dataset.path);
  const PropertyList properties(H5Dget_create_plist(handle.id()));
  if (H5Pget_layout(properties.id()) != H5D_CHUNKED) return piece;
  std::vector<hsize_t> chunk(dataset.shape.size());
  H5Pget_chunk(properties.id(), static_cast<int>(chunk.size()), chunk.data());
  const hsize_t rows = chunk[axis_of_rows(dataset)];
  // Chunks are decompressed whole, so none should be cut in two.
  return std::max<std::uint64_t>(1, piece / rows) * rows;
}

std::optional<Hdf5Place> Hdf5File::find_native_floats(const Hdf5Dataset& dataset) const {
  if (!dataset.is_as_stored()) return std::nullopt;
  const Hdf5Silence silence;
  const Dataset handle = open_dataset(dataset.path);
  const Type type(H5Dget_type(handle.id()));
  if (H5Tequal(type.id(), H5T_NATIVE_FLOAT) <= 0) return std::nullopt;
  const haddr_t offset = H5Dget_offset(handle.id());  // undefined for chunks
  if (offset == HADDR_UNDEF) return std::nullopt;
  return Hdf5Place{file_of_dataset(handle.id()), offset};
}

}  // namespace splotchcl
