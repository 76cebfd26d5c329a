#include "load/smoothing_length_cache.h"

#include <fmt/format.h>

#include <array>
#include <cstring>

#include "common/mapped_file.h"
#include "common/marked_file.h"
#include "common/unfinished_file.h"
#include "scene/word_hash.h"

namespace splotchcl {
namespace {

// The file: this mark, key and count in the machine's own endianness, then the lengths and their
// checksum.
constexpr FileMark mark = {'s', 'p', 'l', 'o', 't', 'c',  'h', 'c',
                           'l', ' ', 'h', ' ', '1', '\n', 0,   0};
constexpr std::size_t header_bytes = mark.size() + 2 * sizeof(std::uint64_t);
constexpr std::size_t checksum_bytes = sizeof(std::uint64_t);

}  // namespace

SmoothingLengthCache::SmoothingLengthCache(const SnapshotInfo& info, int type, std::size_t count,
                                           std::uint64_t key)
    : path_(info.files.front()), key_(key), count_(count) {
  path_ += fmt::format(".type{}.smoothing_lengths", type);
}

std::uint64_t SmoothingLengthCache::key_of(const Column& position,
                                           const std::optional<BoxSides>& periodic_box,
                                           int neighbors) {
  WordHash hash;
  hash.add(static_cast<std::uint64_t>(neighbors));
  for (std::size_t axis = 0; axis < 3; ++axis)
    hash.add(periodic_box ? (*periodic_box)[axis] : 0);
  hash.add(std::uint64_t{position.size() / 3});
  for (std::size_t i = 0; i < position.size(); ++i) {
    std::uint32_t bits = 0;
    const float coordinate = position[i];
    std::memcpy(&bits, &coordinate, sizeof bits);
    hash.add(std::uint64_t{bits});
  }
  return hash.value();
}

std::optional<Column> SmoothingLengthCache::read() const {
  const auto file = MappedFile::open_if_possible(path_);
  const std::uint64_t length_bytes = count_ * sizeof(float);
  if (file == nullptr || file->size() != header_bytes + length_bytes + checksum_bytes)
    return std::nullopt;  // they are computed
  std::array<std::uint64_t, 2> header = {};
  std::memcpy(header.data(), file->data() + mark.size(), sizeof header);
  const bool is_the_same = std::memcmp(file->data(), mark.data(), mark.size()) == 0 &&
                           header[0] == key_ && header[1] == count_;
  const std::byte* const lengths = file->data() + header_bytes;
  std::uint64_t sum = 0;
  std::memcpy(&sum, lengths + length_bytes, sizeof sum);
  if (!is_the_same || sum != checksum(lengths, length_bytes)) return std::nullopt;
  return Column(file, reinterpret_cast<const float*>(lengths), count_);
}

bool SmoothingLengthCache::is_in_the_way() const {
  return is_another_file(path_, mark);
}

void SmoothingLengthCache::write(const Column& lengths) const {
  check_output_path(path_);  // which removes what was left
  UnfinishedFile file(path_);
  const std::array<std::uint64_t, 2> header = {key_, count_};
  file.write(mark.data(), mark.size());
  file.write(header.data(), sizeof header);
  file.write(lengths.data(), count_ * sizeof(float));
  const std::uint64_t sum =
      checksum(reinterpret_cast<const std::byte*>(lengths.data()), count_ * sizeof(float));
  file.write(&sum, sizeof sum);
  file.finish();
}

}  // namespace splotchcl
