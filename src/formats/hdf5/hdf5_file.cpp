#include "formats/hdf5/hdf5_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "common/mapped_file.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

using Group = Hdf5Handle<H5Gclose>;
using Object = Hdf5Handle<H5Oclose>;
using PropertyList = Hdf5Handle<H5Pclose>;
using Space = Hdf5Handle<H5Sclose>;
using Type = Hdf5Handle<H5Tclose>;

// What HDF5 says about its last failure, from where it happened.
std::string last_reason() {
  std::string reason = "no reason given";
  const auto take_first = [](unsigned level, const H5E_error2_t* error, void* text) -> herr_t {
    if (level == 0 && error->desc != nullptr) *static_cast<std::string*>(text) = error->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take_first, &reason);
  return reason;
}

struct OpenedFile {
  Hdf5Handle<H5Fclose> file;
  std::string reason;  // where it is not valid
};

OpenedFile open_by(const std::filesystem::path& path, const PropertyList& properties) {
  OpenedFile opened;
  opened.file = Hdf5Handle<H5Fclose>(H5Fopen(path.c_str(), H5F_ACC_RDONLY, properties.id()));
  if (!opened.file.is_valid()) opened.reason = last_reason();
  return opened;
}

#if H5_VERSION_GE(1, 10, 7)
PropertyList properties_of_locking(bool locks, bool goes_on_without) {
  PropertyList properties(H5Pcreate(H5P_FILE_ACCESS));
  H5Pset_file_locking(properties.id(), locks, goes_on_without);
  return properties;
}

// Reading takes no lock: read-only and network file systems often have none. But a process has a
// file open by one kind of locking only, and h5py may have opened it by another.
OpenedFile open_to_read(const std::filesystem::path& path) {
  OpenedFile opened = open_by(path, properties_of_locking(false, true));
  for (const bool goes_on_without : {false, true}) {
    const bool is_refused_for_locking = opened.reason.find("file locking") != std::string::npos;
    if (is_refused_for_locking)
      opened = open_by(path, properties_of_locking(true, goes_on_without));
  }
  return opened;
}
#else
OpenedFile open_to_read(const std::filesystem::path& path) {
  return open_by(path, PropertyList(H5Pcreate(H5P_FILE_ACCESS)));
}
#endif

std::vector<hsize_t> shape_of(hid_t space) {
  const int rank = H5Sget_simple_extent_ndims(space);
  std::vector<hsize_t> shape(static_cast<std::size_t>(std::max(rank, 0)));
  if (!shape.empty()) H5Sget_simple_extent_dims(space, shape.data(), nullptr);
  return shape;
}

std::string child_path(const std::string& group, const std::string& name) {
  return group == "/" ? group + name : group + "/" + name;
}

// A text of any length, which HDF5 allocates.
std::optional<std::string> variable_text(hid_t attribute, hid_t type) {
  char* text = nullptr;
  if (H5Aread(attribute, type, &text) < 0 || text == nullptr) return std::nullopt;
  std::string value = text;
  H5free_memory(text);
  return value;
}

}  // namespace

// HDF5 would start with its first call otherwise; where memory runs out in that, all later calls
// fail and print why.
void start_hdf5() {
  if (H5open() < 0)
    throw DataError(
        "HDF5 cannot be started, most likely for want of memory; free some and try again");
}

Hdf5Silence::Hdf5Silence() {
  start_hdf5();
  H5Eget_auto2(H5E_DEFAULT, &printer_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}
Hdf5Silence::~Hdf5Silence() {
  H5Eset_auto2(H5E_DEFAULT, printer_, data_);
}

std::uint64_t Hdf5Dataset::values_per_row() const {
  std::uint64_t values = 1;
  for (std::size_t i = 1; i < shape.size(); ++i)
    values *= shape[i];
  return values;
}

bool Hdf5File::has_signature(const std::byte* data, std::uint64_t size) {
  constexpr std::array<unsigned char, 8> signature = {0x89, 'H', 'D', 'F', '\r', '\n', 0x1a, '\n'};
  // The file may begin with a block of the user's, of 512 bytes or a doubling of that.
  for (std::uint64_t at = 0; at + signature.size() <= size; at = at == 0 ? 512 : 2 * at) {
    if (std::memcmp(data + at, signature.data(), signature.size()) == 0) return true;
  }
  return false;
}

Hdf5File::Hdf5File(const std::filesystem::path& path)
    : path_(path), links_((start_hdf5(), std::make_unique<Hdf5Links>())), rules_(*links_) {
  const Hdf5Silence silence;
  require_regular_file(path);
  OpenedFile opened = open_to_read(path);
  if (!opened.file.is_valid()) fail("HDF5 cannot open it", opened.reason);
  file_ = std::move(opened.file);
}

std::vector<std::string> Hdf5File::children(const std::string& group, H5I_type_t wanted) const {
  struct Search {
    H5I_type_t wanted;
    hid_t properties;
    std::vector<std::string> names;
  } search = {wanted, rules_.of_links(), {}};
  const Group handle(H5Gopen2(file_.id(), group.c_str(), rules_.of_groups()));
  if (!handle.is_valid()) fail(fmt::format("group {} cannot be opened", group));
  const auto visit = [](hid_t id, const char* name, const H5L_info_t*, void* data) -> herr_t {
    auto& found = *static_cast<Search*>(data);
    // A link may lead nowhere; what does not exist is not listed.
    const Object object(H5Oopen(id, name, found.properties));
    try {  // nothing may be thrown through HDF5
      if (object.is_valid() && H5Iget_type(object.id()) == found.wanted)
        found.names.emplace_back(name);
    } catch (const std::exception&) {
      return -1;
    }
    return 0;
  };
  if (H5Literate(handle.id(), H5_INDEX_NAME, H5_ITER_INC, nullptr, visit, &search) < 0) {
    fail(fmt::format("group {} cannot be listed", group));
  }
  return search.names;
}

void Hdf5File::fail(const std::string& what) const {
  fail(what, last_reason());
}

void Hdf5File::fail(const std::string& what, const std::string& reason) const {
  throw DataError(
      fmt::format("{}: {}: {}; the file is truncated, damaged or not HDF5: copy or write it again",
                  path_.string(), what, reason));
}

bool Hdf5File::has(const std::string& object) const {
  const Hdf5Silence silence;
  // Each step of the path must exist before the next may be asked for.
  for (std::size_t end = object.find('/', 1);; end = object.find('/', end + 1)) {
    const std::string step = object.substr(0, end);
    if (H5Lexists(file_.id(), step.c_str(), rules_.of_links()) <= 0) return false;
    if (end == std::string::npos) break;
  }
  return H5Oexists_by_name(file_.id(), object.c_str(), rules_.of_links()) > 0;
}

std::vector<std::string> Hdf5File::groups(const std::string& group) const {
  const Hdf5Silence silence;
  return children(group, H5I_GROUP);
}

std::vector<Hdf5Dataset> Hdf5File::datasets(const std::string& group) const {
  const Hdf5Silence silence;
  std::vector<Hdf5Dataset> result;
  for (const std::string& name : children(group, H5I_DATASET)) {
    result.push_back(dataset(child_path(group, name)));
  }
  return result;
}

Hdf5File::Dataset Hdf5File::open_dataset(const std::string& path) const {
  Dataset handle(H5Dopen2(file_.id(), path.c_str(), rules_.of_datasets()));
  if (!handle.is_valid()) fail(fmt::format("dataset {} cannot be opened", path));
  check_virtual_sources(handle.id(), *links_);
  return handle;
}

Hdf5Dataset Hdf5File::dataset(const std::string& path) const {
  const Hdf5Silence silence;
  const Dataset handle = open_dataset(path);
  const Space space(H5Dget_space(handle.id()));
  const Type type(H5Dget_type(handle.id()));
  if (!space.is_valid() || !type.is_valid()) fail(fmt::format("dataset {} is damaged", path));
  Hdf5Dataset result;
  result.path = path;
  result.shape = shape_of(space.id());
  result.bytes_per_value = H5Tget_size(type.id());
  const H5T_class_t kind = H5Tget_class(type.id());
  if (kind == H5T_FLOAT) result.kind = Hdf5Dataset::Kind::real;
  // h5py's truth values are named numbers.
  const bool are_named =
      kind == H5T_ENUM && H5Tget_class(Type(H5Tget_super(type.id())).id()) == H5T_INTEGER;
  if (kind == H5T_INTEGER || are_named) result.kind = Hdf5Dataset::Kind::integer;
  return result;
}

// Not valid where there is none.
Hdf5File::Attribute Hdf5File::open_attribute(const std::string& object,
                                             const std::string& name) const {
  if (!has(object)) return {};
  const Object owner(H5Oopen(file_.id(), object.c_str(), rules_.of_links()));
  if (H5Aexists(owner.id(), name.c_str()) <= 0) return {};
  return Attribute(H5Aopen(owner.id(), name.c_str(), H5P_DEFAULT));
}

std::optional<std::vector<double>> Hdf5File::numbers(const std::string& object,
                                                     const std::string& name) const {
  const Hdf5Silence silence;
  const Attribute attribute = open_attribute(object, name);
  if (!attribute.is_valid()) return std::nullopt;
  const Type type(H5Aget_type(attribute.id()));
  const H5T_class_t kind = H5Tget_class(type.id());
  if (kind != H5T_FLOAT && kind != H5T_INTEGER) return std::nullopt;
  const Space space(H5Aget_space(attribute.id()));
  // Attributes live in object headers of at most 64 KiB or in dense storage; either way
  // the number of points is bounded by what HDF5 has already read.
  std::vector<double> values(
      static_cast<std::size_t>(std::max<hssize_t>(0, H5Sget_simple_extent_npoints(space.id()))));
  if (values.empty() || H5Aread(attribute.id(), H5T_NATIVE_DOUBLE, values.data()) < 0) {
    fail(fmt::format("attribute {} of {} cannot be read", name, object));
  }
  return values;
}

std::optional<double> Hdf5File::number(const std::string& object, const std::string& name) const {
  const auto values = numbers(object, name);
  return values ? std::optional<double>(values->front()) : std::nullopt;
}

std::optional<std::string> Hdf5File::text(const std::string& object,
                                          const std::string& name) const {
  const Hdf5Silence silence;
  const Attribute attribute = open_attribute(object, name);
  if (!attribute.is_valid()) return std::nullopt;
  const Type type(H5Aget_type(attribute.id()));
  const Space space(H5Aget_space(attribute.id()));
  const bool is_one_text =
      H5Tget_class(type.id()) == H5T_STRING && H5Sget_simple_extent_npoints(space.id()) == 1;
  if (!is_one_text) return std::nullopt;
  if (H5Tis_variable_str(type.id()) > 0) return variable_text(attribute.id(), type.id());
  std::string value(H5Tget_size(type.id()), '\0');
  if (H5Aread(attribute.id(), type.id(), value.data()) < 0) return std::nullopt;
  return std::string(value.c_str());
}

void Hdf5File::read(const Hdf5Dataset& dataset, std::uint64_t first, std::uint64_t rows, hid_t type,
                    void* out) const {
  const Hdf5Silence silence;
  const Dataset handle = open_dataset(dataset.path);
  const Space file_space(H5Dget_space(handle.id()));
  std::vector<hsize_t> count = dataset.shape;
  if (count.empty()) {  // a single value
    if (H5Dread(handle.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, out) < 0) {
      fail(fmt::format("dataset {} cannot be read", dataset.path));
    }
    return;
  }
  std::vector<hsize_t> start(count.size(), 0);
  start[0] = first;
  count[0] = rows;
  const Space memory(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr));
  const bool is_read =
      H5Sselect_hyperslab(file_space.id(), H5S_SELECT_SET, start.data(), nullptr, count.data(),
                          nullptr) >= 0 &&
      H5Dread(handle.id(), type, memory.id(), file_space.id(), H5P_DEFAULT, out) >= 0;
  if (!is_read) fail(fmt::format("dataset {} cannot be read", dataset.path));
}

void Hdf5File::read_rows(const Hdf5Dataset& dataset, std::uint64_t first, std::uint64_t rows,
                         float* out) const {
  read(dataset, first, rows, H5T_NATIVE_FLOAT, out);
}

void Hdf5File::read_rows(const Hdf5Dataset& dataset, std::uint64_t first, std::uint64_t rows,
                         double* out) const {
  read(dataset, first, rows, H5T_NATIVE_DOUBLE, out);
}

void Hdf5File::read_rows(const Hdf5Dataset& dataset, std::uint64_t first, std::uint64_t rows,
                         std::uint64_t* out) const {
  const Dataset handle = open_dataset(dataset.path);
  const Hdf5Handle<H5Tclose> stored(H5Dget_type(handle.id()));
  // HDF5 would make 0 of all below it.
  const bool is_signed = H5Tget_sign(stored.id()) == H5T_SGN_2;
  read(dataset, first, rows, is_signed ? H5T_NATIVE_INT64 : H5T_NATIVE_UINT64, out);
}

std::uint64_t Hdf5File::rows_per_piece(const Hdf5Dataset& dataset) const {
  constexpr std::uint64_t piece = 1U << 20;
  const Hdf5Silence silence;
  const Dataset handle = open_dataset(dataset.path);
  const PropertyList properties(H5Dget_create_plist(handle.id()));
  if (H5Pget_layout(properties.id()) != H5D_CHUNKED) return piece;
  std::vector<hsize_t> chunk(dataset.shape.size());
  H5Pget_chunk(properties.id(), static_cast<int>(chunk.size()), chunk.data());
  // Chunks are decompressed whole, so none should be cut in two.
  return std::max<std::uint64_t>(1, piece / chunk[0]) * chunk[0];
}

std::optional<Hdf5Place> Hdf5File::find_native_floats(const Hdf5Dataset& dataset) const {
  const Hdf5Silence silence;
  const Dataset handle = open_dataset(dataset.path);
  const Type type(H5Dget_type(handle.id()));
  if (H5Tequal(type.id(), H5T_NATIVE_FLOAT) <= 0) return std::nullopt;
  const haddr_t offset = H5Dget_offset(handle.id());  // undefined for chunks
  if (offset == HADDR_UNDEF) return std::nullopt;
  return Hdf5Place{file_of_dataset(handle.id()), offset};
}

}  // namespace splotchcl
