// Whether a file holds what its datasets claim: HDF5 itself reads fill values for all that was
// never written, after memory has been taken for it.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "formats/hdf5/hdf5_file.h"
#include "formats/snapshot_format.h"
#include "scene/ceil_divide.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

using PropertyList = Hdf5Handle<H5Pclose>;
using Space = Hdf5Handle<H5Sclose>;

// None where the count overflows.
std::optional<std::uint64_t> bytes_of(const Hdf5Dataset& dataset) {
  std::uint64_t bytes = dataset.bytes_per_value;
  for (const hsize_t side : dataset.shape) {
    if (__builtin_mul_overflow(bytes, side, &bytes)) return std::nullopt;
  }
  return bytes;
}

struct Filter {
  H5Z_filter_t id;
  std::string name;
};

std::vector<Filter> filters_of(hid_t properties) {
  std::vector<Filter> filters;
  const int count = H5Pget_nfilters(properties);
  for (int i = 0; i < count; ++i) {
    unsigned flags = 0, config = 0;
    std::size_t values = 0;
    std::array<char, 64> name = {};
    const H5Z_filter_t id = H5Pget_filter2(properties, static_cast<unsigned>(i), &flags, &values,
                                           nullptr, name.size(), name.data(), &config);
    filters.push_back({id, name.data()});
  }
  return filters;
}

// How many times larger than what is stored the values may be; 0 where anything is possible.
std::uint64_t packing_of(const std::vector<Filter>& filters) {
  const auto is_plain = [](const Filter& filter) {
    return filter.id == H5Z_FILTER_SHUFFLE || filter.id == H5Z_FILTER_FLETCHER32;
  };
  const auto is_known = [&](const Filter& filter) {
    return is_plain(filter) || filter.id == H5Z_FILTER_DEFLATE;
  };
  if (std::all_of(filters.begin(), filters.end(), is_plain)) return 1;
  return std::all_of(filters.begin(), filters.end(), is_known) ? best_packing_of_deflate : 0;
}

bool has_all_bytes(const Hdf5Dataset& dataset, hid_t handle) {
  const Hdf5Handle<H5Fclose> file(H5Iget_file_id(handle));  // that which the dataset lies in
  hsize_t size = 0;
  H5Fget_filesize(file.id(), &size);
  const auto bytes = bytes_of(dataset);
  return bytes && *bytes <= size && H5Dget_storage_size(handle) == *bytes;
}

bool has_all_chunks(const Hdf5Dataset& dataset, hid_t handle, hid_t properties) {
  const auto bytes = bytes_of(dataset);
  if (!bytes) return false;
  const std::uint64_t packing = packing_of(filters_of(properties));
  if (packing > 0 && *bytes / packing > H5Dget_storage_size(handle)) return false;
  std::vector<hsize_t> chunk(dataset.shape.size());
  H5Pget_chunk(properties, static_cast<int>(chunk.size()), chunk.data());
  const Space space(H5Dget_space(handle));
  hsize_t stored = 0;
  H5Dget_num_chunks(handle, space.id(), &stored);
  hsize_t needed = 1;
  for (std::size_t i = 0; i < chunk.size() && needed <= stored; ++i) {
    needed *= ceil_divide(dataset.shape[i], chunk[i]);
  }
  return needed <= stored;
}

}  // namespace

void Hdf5File::check_filters(const std::string& dataset, hid_t properties) const {
  for (const Filter& filter : filters_of(properties)) {
    if (H5Zfilter_avail(filter.id) > 0) continue;
    throw DataError(fmt::format(
        "{}: dataset {} is packed with {} (HDF5's filter {}), which cannot be unpacked here; "
        "install its plugin for HDF5, or unpack the file with h5repack -f NONE where it can be",
        path_.string(), dataset, filter.name.empty() ? "an unnamed filter" : filter.name,
        filter.id));
  }
}

void Hdf5File::check_source(const std::string& dataset, const std::filesystem::path& owner,
                            const std::filesystem::path& file, const std::string& source,
                            int depth) const {
  constexpr int deepest = 8;
  const bool is_self = file == "." || file == owner.filename();
  const std::filesystem::path place = is_self ? owner : find_virtual_source(owner, file);
  std::error_code ignored;
  if (depth < deepest && std::filesystem::exists(place, ignored)) {
    const Hdf5File parts(place);
    if (parts.has(source)) return parts.check_complete(parts.dataset(source), depth + 1);
  }
  throw DataError(
      fmt::format("{}: dataset {} is made of {} in {}, which is missing; put all files of the "
                  "snapshot into the same folder",
                  path_.string(), dataset, source, place.string()));
}

// HDF5 reads zeros where what a virtual dataset points to is missing. False where its parts are
// less than the whole.
bool Hdf5File::check_sources(const Hdf5Dataset& dataset, hid_t handle, hid_t properties,
                             int depth) const {
  const std::filesystem::path owner = file_of_dataset(handle);
  std::size_t sources = 0;
  H5Pget_virtual_count(properties, &sources);
  const auto bytes = bytes_of(dataset);
  std::uint64_t mapped = 0;
  bool is_open = false;  // as long as its sources are
  for (std::size_t i = 0; i < sources; ++i) {
    const std::string file = virtual_source_name(H5Pget_virtual_filename, properties, i);
    const Space part(H5Pget_virtual_vspace(properties, i));
    const hssize_t values = H5Sget_select_npoints(part.id());
    if (values == static_cast<hssize_t>(H5S_UNLIMITED) || values < 0) is_open = true;
    if (!is_open) mapped += static_cast<std::uint64_t>(values) * dataset.bytes_per_value;
    // A pattern for as many files as there are: the shape follows from those.
    if (file.find('%') != std::string::npos) {
      is_open = true;
      continue;
    }
    check_source(dataset.path, owner, file,
                 virtual_source_name(H5Pget_virtual_dsetname, properties, i), depth);
  }
  return is_open || (bytes && *bytes <= mapped);
}

void Hdf5File::check_complete(const Hdf5Dataset& dataset, int depth) const {
  const Hdf5Silence silence;
  // What is there of one member is there of all.
  if (!dataset.member.empty()) return check_complete(this->dataset(dataset.path), depth);
  const Dataset handle = open_dataset(dataset.path);
  const PropertyList properties(H5Dget_create_plist(handle.id()));
  const H5D_layout_t layout = H5Pget_layout(properties.id());
  check_filters(dataset.path, properties.id());
  if (H5Pget_external_count(properties.id()) > 0) {
    throw DataError(fmt::format(
        "{}: the values of dataset {} lie outside of the file, which is not read; bring them into "
        "one file with h5repack",
        path_.string(), dataset.path));
  }
  bool is_complete = true;
  if (bytes_of(dataset) == std::uint64_t{0}) return;
  if (layout == H5D_CONTIGUOUS) is_complete = has_all_bytes(dataset, handle.id());
  if (layout == H5D_CHUNKED) is_complete = has_all_chunks(dataset, handle.id(), properties.id());
  if (layout == H5D_VIRTUAL)
    is_complete = check_sources(dataset, handle.id(), properties.id(), depth);
  if (is_complete) return;
  throw DataError(
      fmt::format("{}: dataset {} should hold {} rows, but they are not all in the file; it was "
                  "not completely written, or is damaged",
                  path_.string(), dataset.path, dataset.rows()));
}

}  // namespace splotchcl
