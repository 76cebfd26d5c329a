#include "formats/hdf5/hdf5_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "common/mapped_file.h"
#include "common/words.h"
#include "formats/snapshot_format.h"
#include "splotchcl/error.h"

namespace splotchcl {

std::string Hdf5Dataset::label() const {
  if (member.empty()) return path.substr(path.rfind('/') + 1);
  return fmt::format("{}", fmt::join(member, "."));
}

std::string Hdf5Dataset::name() const {
  std::string text = path;
  if (!member.empty()) text += ":" + label();
  if (column) text += ":" + std::to_string(*column);
  return text;
}

std::uint64_t Hdf5Dataset::rows() const {
  if (shape.empty()) return 1;
  return has_axes_first ? shape[1] : shape[0];
}

std::uint64_t Hdf5Dataset::stored_values_per_row() const {
  if (has_axes_first) return shape[0];
  std::uint64_t values = 1;
  for (std::size_t i = 1; i < shape.size(); ++i)
    values *= shape[i];
  return values;
}

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

void describe_values(hid_t type, Hdf5Dataset& dataset) {
  const H5T_class_t kind = H5Tget_class(type);
  dataset.bytes_per_value = H5Tget_size(type);
  if (kind == H5T_FLOAT) dataset.kind = Hdf5Dataset::Kind::real;
  if (kind == H5T_COMPOUND) dataset.kind = Hdf5Dataset::Kind::records;
  // h5py's truth values are named numbers.
  const bool are_named =
      kind == H5T_ENUM && H5Tget_class(Type(H5Tget_super(type)).id()) == H5T_INTEGER;
  if (kind != H5T_INTEGER && !are_named) return;
  dataset.kind = Hdf5Dataset::Kind::integer;
  const Type number(are_named ? H5Tget_super(type) : H5Tcopy(type));
  dataset.is_signed = H5Tget_sign(number.id()) == H5T_SGN_2;
}

// Of arrays their values, with the array's shape behind the dataset's.
void describe_member(hid_t type, Hdf5Dataset& member) {
  if (H5Tget_class(type) != H5T_ARRAY) return describe_values(type, member);
  std::vector<hsize_t> shape(static_cast<std::size_t>(std::max(H5Tget_array_ndims(type), 0)));
  if (!shape.empty()) H5Tget_array_dims2(type, shape.data());
  member.shape.insert(member.shape.end(), shape.begin(), shape.end());
  describe_values(Type(H5Tget_super(type)).id(), member);
  // Records in arrays are no rows.
  if (member.kind == Hdf5Dataset::Kind::records) member.kind = Hdf5Dataset::Kind::other;
}

std::string member_name(hid_t records, unsigned number) {
  char* const name = H5Tget_member_name(records, number);
  const std::string text = name == nullptr ? "" : name;
  H5free_memory(name);
  return text;
}

void add_members(hid_t type, const Hdf5Dataset& of, std::vector<Hdf5Dataset>& found) {
  constexpr std::size_t deepest = 4;
  const int members = H5Tget_nmembers(type);
  for (int i = 0; i < members && found.size() < most_columns; ++i) {
    const Type inner(H5Tget_member_type(type, static_cast<unsigned>(i)));
    if (!inner.is_valid()) continue;
    Hdf5Dataset member = of;
    member.kind = Hdf5Dataset::Kind::other;
    member.member.push_back(member_name(type, static_cast<unsigned>(i)));
    describe_member(inner.id(), member);
    if (member.kind != Hdf5Dataset::Kind::records) {
      found.push_back(std::move(member));
    } else if (member.member.size() < deepest) {
      add_members(inner.id(), member, found);
    }
  }
}

// None where one of them is no number.
std::optional<std::vector<double>> numbers_in(const std::vector<std::string>& texts) {
  std::vector<double> numbers;
  for (const std::string& text : texts) {
    const auto number = parse_number(trimmed(text));
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers.empty() ? std::nullopt : std::optional(std::move(numbers));
}

// A link that leads nowhere: "/PartType0/Density, a link to /gone,"; to "part.hdf5: /gone" in
// another file. What is refused has been told already.
void add_dead_link(hid_t group, const char* name, const H5L_info_t& link, const std::string& path,
                   Hdf5Links& links) {
  constexpr std::size_t longest = 4096;
  if (link.type == H5L_TYPE_HARD || link.u.val_size > longest) return;
  std::vector<char> value(link.u.val_size + 1, '\0');
  if (H5Lget_val(group, name, value.data(), link.u.val_size, H5P_DEFAULT) < 0) return;
  std::string place = value.data();
  const char *file = nullptr, *object = nullptr;
  if (link.type == H5L_TYPE_EXTERNAL) {
    if (H5Lunpack_elink_val(value.data(), link.u.val_size, nullptr, &file, &object) < 0) return;
    if (links.refused.count(file) > 0) return;
    place = fmt::format("{}: {}", file, object);
  }
  links.dead.insert(fmt::format("{}, a link to {},", path, place));
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
    const std::string& group;
    Hdf5Links& links;
    std::vector<std::string> names;
  } search = {wanted, rules_.of_links(), group, *links_, {}};
  const Group handle(H5Gopen2(file_.id(), group.c_str(), rules_.of_groups()));
  if (!handle.is_valid()) fail(fmt::format("group {} cannot be opened", group));
  const auto visit = [](hid_t id, const char* name, const H5L_info_t* link, void* data) -> herr_t {
    auto& found = *static_cast<Search*>(data);
    const Object object(H5Oopen(id, name, found.properties));
    try {  // nothing may be thrown through HDF5
      if (!object.is_valid())
        add_dead_link(id, name, *link, child_path(found.group, name), found.links);
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

bool Hdf5File::is_soft_link(const std::string& object) const {
  const Hdf5Silence silence;
  H5L_info_t link;
  return H5Lget_info(file_.id(), object.c_str(), &link, rules_.of_links()) >= 0 &&
         link.type == H5L_TYPE_SOFT;
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

std::vector<std::string> Hdf5File::dataset_names(const std::string& group) const {
  const Hdf5Silence silence;
  return children(group, H5I_DATASET);
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
  describe_values(type.id(), result);
  return result;
}

std::vector<Hdf5Dataset> Hdf5File::members(const Hdf5Dataset& records) const {
  const Hdf5Silence silence;
  const Dataset handle = open_dataset(records.path);
  const Type type(H5Dget_type(handle.id()));
  std::vector<Hdf5Dataset> found;
  Hdf5Dataset whole = records;
  whole.member.clear();
  if (records.kind == Hdf5Dataset::Kind::records) add_members(type.id(), whole, found);
  return found;
}

std::vector<std::string> Hdf5File::lines(const std::string& path) const {
  const Hdf5Silence silence;
  const Hdf5Dataset dataset = this->dataset(path);
  const Dataset handle = open_dataset(path);
  const Type type(H5Dget_type(handle.id()));
  const bool are_texts =
      H5Tget_class(type.id()) == H5T_STRING && H5Tis_variable_str(type.id()) == 0;
  if (!are_texts || dataset.shape.size() != 1 || dataset.bytes_per_value == 0) return {};
  check_complete(dataset);
  std::vector<char> text(dataset.rows() * dataset.bytes_per_value);
  if (!text.empty() &&
      H5Dread(handle.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) < 0) {
    fail(fmt::format("dataset {} cannot be read", path));
  }
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size(); begin += dataset.bytes_per_value) {
    const std::string line(text.data() + begin, dataset.bytes_per_value);
    lines.push_back(line.substr(0, line.find('\0')));
  }
  return lines;
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
  if (kind == H5T_STRING) return numbers_in(texts(attribute.id()));
  // h5py writes true and false as an enumeration.
  if (kind != H5T_FLOAT && kind != H5T_INTEGER && kind != H5T_ENUM) return std::nullopt;
  const Space space(H5Aget_space(attribute.id()));
  // Attributes live in object headers of at most 64 KiB or in dense storage; either way
  // the number of points is bounded by what HDF5 has already read.
  std::vector<double> values(
      static_cast<std::size_t>(std::max<hssize_t>(0, H5Sget_simple_extent_npoints(space.id()))));
  if (values.empty()) return std::nullopt;  // it states nothing
  if (H5Aread(attribute.id(), H5T_NATIVE_DOUBLE, values.data()) < 0) {
    fail(fmt::format("attribute {} of {} cannot be read", name, object));
  }
  return values;
}

std::optional<double> Hdf5File::number(const std::string& object, const std::string& name) const {
  const auto values = numbers(object, name);
  return values ? std::optional<double>(values->front()) : std::nullopt;
}

// An attribute's texts, of any length or of one.
std::vector<std::string> Hdf5File::texts(hid_t attribute) const {
  const Type type(H5Aget_type(attribute));
  const Space space(H5Aget_space(attribute));
  const auto count =
      static_cast<std::size_t>(std::max<hssize_t>(0, H5Sget_simple_extent_npoints(space.id())));
  std::vector<std::string> texts;
  if (H5Tis_variable_str(type.id()) > 0) {
    std::vector<char*> pointers(count, nullptr);
    if (count == 0 || H5Aread(attribute, type.id(), pointers.data()) < 0) return texts;
    for (const char* const text : pointers)
      texts.emplace_back(text == nullptr ? "" : text);
    H5Dvlen_reclaim(type.id(), space.id(), H5P_DEFAULT, pointers.data());
    return texts;
  }
  const std::size_t length = H5Tget_size(type.id());
  std::string bytes(count * length, '\0');
  if (bytes.empty() || H5Aread(attribute, type.id(), bytes.data()) < 0) return texts;
  for (std::size_t begin = 0; begin < bytes.size(); begin += length)
    texts.emplace_back(bytes.substr(begin, length).c_str());
  return texts;
}

std::optional<std::string> Hdf5File::text(const std::string& object,
                                          const std::string& name) const {
  const Hdf5Silence silence;
  const Attribute attribute = open_attribute(object, name);
  if (!attribute.is_valid()) return std::nullopt;
  const Type type(H5Aget_type(attribute.id()));
  if (H5Tget_class(type.id()) != H5T_STRING) return std::nullopt;
  const std::vector<std::string> found = texts(attribute.id());
  return found.size() == 1 ? std::optional(found.front()) : std::nullopt;
}

}  // namespace splotchcl
