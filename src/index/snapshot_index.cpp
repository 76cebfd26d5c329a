#include "index/snapshot_index.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "common/mapped_file.h"
#include "common/unfinished_file.h"
#include "parallel/for_blocks.h"
#include "scene/ceil_divide.h"
#include "scene/hash.h"
#include "scene/particle_columns.h"
#include "scene/particle_rules.h"
#include "snapshot/field_names.h"
#include "snapshot/snapshot_files.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

// The file: this mark, then in the machine's own endianness key and number of types; of each type a
// TypeHeader and its boxes; the checksum of all that comes before it.
constexpr FileMark mark = {'s', 'p', 'l', 'o', 't', 'c',  'h', 'c',
                           'l', ' ', 'i', ' ', '1', '\n', 0,   0};
struct FileHeader {
  FileMark mark;
  std::uint64_t key, types;
};
struct TypeHeader {
  std::int64_t type;
  std::uint64_t count, has_smoothing_lengths;
};
static_assert(sizeof(FileHeader) == 32 && sizeof(TypeHeader) == 24 && sizeof(ParticleBox) == 28);

std::uint64_t blocks_of(std::uint64_t count) {
  return ceil_divide(count, SnapshotIndex::block_particles);
}

// Of all that the boxes follow from: the files, and what of them positions and lengths are.
std::uint64_t key_of(const SnapshotInfo& info) {
  WordHash hash = hash_of_files(info);
  for (const ParticleTypeInfo& type : info.types) {
    hash.add(static_cast<std::uint64_t>(type.type));
    hash.add(type.count);
    for (const char* const name : {"position", "smoothing_length"}) {
      const FieldInfo* const field = find_field(type, name);
      hash.add(field == nullptr ? std::string() : field->file_name);
    }
  }
  return hash.value();
}

// Tables of text are read as a whole, and which column is which a scene may say anew.
bool has_parts(const SnapshotInfo& info) {
  const auto begins_with = [&info](const char* word) { return info.format.rfind(word, 0) == 0; };
  std::error_code missing;
  return !begins_with("text") && !begins_with("NumPy") && !info.files.empty() &&
         std::filesystem::exists(info.files.front(), missing);
}

void take_in(const float* position, float h, ParticleBox& box) {
  for (int axis = 0; axis < 3; ++axis) {
    box.lower[axis] = std::min(box.lower[axis], position[axis]);
    box.upper[axis] = std::max(box.upper[axis], position[axis]);
  }
  box.largest_smoothing_length = std::max(box.largest_smoothing_length, h);
}

// `lengths` may be absent.
ParticleBox box_of(const Column& positions, const Column& lengths, std::size_t begin,
                   std::size_t end) {
  const ColumnStretch position(positions, 3 * begin, 3 * end);
  const ColumnStretch length(lengths, begin, end);
  ParticleBox box = {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}, 0};
  for (std::size_t i = begin; i < end; ++i) {
    const float at[3] = {position[3 * i], position[3 * i + 1], position[3 * i + 2]};
    const float h = lengths.is_absent() ? 0.0f : length[i];
    if (!is_finite_position(at) || (!lengths.is_absent() && !is_smoothing_length(h)))
      return {{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}, infinity};
    take_in(at, h, box);
  }
  return box;
}

SnapshotIndex::Type index_type(const Snapshot& snapshot, const ParticleTypeInfo& info,
                               const std::function<void(double)>& progress) {
  SnapshotIndex::Type type;
  type.type = info.type;
  type.count = info.count;
  const FieldInfo* const length = find_field(info, "smoothing_length");
  type.has_smoothing_lengths = length != nullptr;
  const Column positions = snapshot.read(info.type, "position");
  const Column lengths = length == nullptr ? Column() : snapshot.read(info.type, length->name);
  type.boxes.resize(blocks_of(info.count));
  const std::size_t count = static_cast<std::size_t>(info.count);
  for_blocks(
      type.boxes.size(), streamed_particles / SnapshotIndex::block_particles,
      [&](std::size_t first, std::size_t end) {
        for (std::size_t b = first; b < end; ++b) {
          const std::size_t begin = b * SnapshotIndex::block_particles;
          type.boxes[b] = box_of(positions, lengths, begin,
                                 std::min(count, begin + SnapshotIndex::block_particles));
        }
      },
      progress);
  return type;
}

// Of the index of such a snapshot: only a file as long is read.
std::uint64_t file_bytes(const SnapshotInfo& info) {
  std::uint64_t bytes = sizeof(FileHeader) + sizeof(std::uint64_t);
  for (const ParticleTypeInfo& type : info.types)
    bytes += sizeof(TypeHeader) + blocks_of(type.count) * sizeof(ParticleBox);
  return bytes;
}

// Takes values from a file's bytes, one after the other.
class Bytes {
 public:
  explicit Bytes(const MappedFile& file) : next_(file.data()), left_(file.size()) {}

  // False where the file ends before.
  bool take(void* to, std::uint64_t bytes) {
    if (bytes > left_) return false;
    std::memcpy(to, next_, static_cast<std::size_t>(bytes));
    next_ += bytes;
    left_ -= bytes;
    return true;
  }
  std::uint64_t left() const { return left_; }

 private:
  const std::byte* next_;
  std::uint64_t left_;
};

bool ends_with_its_checksum(const MappedFile& file) {
  std::uint64_t sum = 0;
  if (file.size() < sizeof sum) return false;
  const auto size = static_cast<std::size_t>(file.size()) - sizeof sum;
  std::memcpy(&sum, file.data() + size, sizeof sum);
  return sum == checksum(file.data(), size);
}

void append(std::vector<std::byte>& bytes, const void* from, std::size_t size) {
  const auto* const first = static_cast<const std::byte*>(from);
  bytes.insert(bytes.end(), first, first + size);
}

bool is_regular(const std::filesystem::path& path) {
  std::error_code missing;
  return std::filesystem::is_regular_file(path, missing);
}

}  // namespace

std::filesystem::path SnapshotIndex::path_for(const SnapshotInfo& info) {
  std::filesystem::path path = info.files.front();
  path += ".splotchcl_index";
  return path;
}

SnapshotIndex SnapshotIndex::make(const Snapshot& snapshot,
                                  const std::function<void(double)>& progress) {
  const SnapshotInfo& info = snapshot.info();
  if (!is_of_use(info)) {
    throw UsageError(fmt::format(
        "{}: {} cannot be read in parts, expected a whole snapshot of a format that can, such as "
        "Gadget's or HDF5; store it as one first, such as HDF5 by h5py",
        info.files.empty() ? "the snapshot" : info.files.front().string(), info.format));
  }
  SnapshotIndex index;
  for (const ParticleTypeInfo& type : info.types)
    index.types_.push_back(index_type(snapshot, type, progress));
  return index;
}

SnapshotIndex SnapshotIndex::of(std::vector<Type> types) {
  SnapshotIndex index;
  index.types_ = std::move(types);
  return index;
}

std::optional<SnapshotIndex> SnapshotIndex::read(const SnapshotInfo& info) {
  if (!is_there(info) || !has_files_as_opened(info)) return std::nullopt;
  const auto file = MappedFile::open_if_possible(path_for(info));
  if (file == nullptr || file->size() != file_bytes(info) || !ends_with_its_checksum(*file))
    return std::nullopt;
  Bytes bytes(*file);
  FileHeader header{};
  if (!bytes.take(&header, sizeof header) || header.mark != mark || header.key != key_of(info) ||
      header.types != info.types.size())
    return std::nullopt;
  SnapshotIndex index;
  for (const ParticleTypeInfo& expected : info.types) {
    TypeHeader found{};
    if (!bytes.take(&found, sizeof found) || found.type != expected.type ||
        found.count != expected.count ||
        bytes.left() / sizeof(ParticleBox) < blocks_of(found.count))
      return std::nullopt;
    Type type;
    type.type = expected.type;
    type.count = found.count;
    type.has_smoothing_lengths = found.has_smoothing_lengths != 0;
    type.boxes.resize(static_cast<std::size_t>(blocks_of(found.count)));
    bytes.take(type.boxes.data(), type.boxes.size() * sizeof(ParticleBox));
    index.types_.push_back(std::move(type));
  }
  return index;
}

bool SnapshotIndex::is_of_use(const SnapshotInfo& info) {
  return info.has_positions_of_files && info.is_whole() && has_parts(info);
}

bool SnapshotIndex::is_there(const SnapshotInfo& info) {
  return is_of_use(info) && is_regular(path_for(info));
}

void SnapshotIndex::write(const SnapshotInfo& info) const {
  const std::filesystem::path path = path_for(info);
  if (is_another_file(path, mark)) {
    throw UsageError(fmt::format(
        "{}: found a file that is no index, expected none or an index; move it", path.string()));
  }
  if (!has_files_as_opened(info)) {
    throw DataError(info.files.front().string() +
                    ": was written anew while its index was made; make it again when the snapshot "
                    "is complete");
  }
  std::vector<std::byte> bytes;
  const FileHeader header = {mark, key_of(info), types_.size()};
  append(bytes, &header, sizeof header);
  for (const Type& type : types_) {
    const TypeHeader head = {type.type, type.count, type.has_smoothing_lengths ? 1u : 0u};
    append(bytes, &head, sizeof head);
    append(bytes, type.boxes.data(), type.boxes.size() * sizeof(ParticleBox));
  }
  const std::uint64_t sum = checksum(bytes.data(), bytes.size());
  append(bytes, &sum, sizeof sum);
  check_output_path(path);  // which removes what was left
  UnfinishedFile file(path);
  file.write(bytes.data(), bytes.size());
  file.finish();
}

const SnapshotIndex::Type* SnapshotIndex::find(int type) const {
  const auto found = std::find_if(types_.begin(), types_.end(),
                                  [type](const Type& known) { return known.type == type; });
  return found == types_.end() ? nullptr : &*found;
}

}  // namespace splotchcl
