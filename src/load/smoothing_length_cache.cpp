#include "load/smoothing_length_cache.h"

#include <fmt/format.h>

#include <array>
#include <cstring>

#include "common/mapped_file.h"
#include "common/marked_file.h"
#include "common/unfinished_file.h"
#include "common/word_hash.h"

namespace splotchcl {
namespace {

// The file: this mark, key and count in the machine's own endianness, then the lengths.
constexpr FileMark mark = {'s', 'p', 'l', 'o', 't', 'c',  'h', 'c',
                           'l', ' ', 'h', ' ', '1', '\n', 0,   0};
constexpr std::size_t header_bytes = mark.size() + 2 * sizeof(std::uint64_t);

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
  std::error_code ignored;
  const bool has_length =
      std::filesystem::file_size(path_, ignored) == header_bytes + count_ * sizeof(float);
  if (!has_length) return std::nullopt;
  const auto file = MappedFile::open_if_possible(path_);
  if (file == nullptr) return std::nullopt;  // they are computed
  std::array<std::uint64_t, 2> header = {};
  std::memcpy(header.data(), file->data() + mark.size(), sizeof header);
  const bool is_the_same = std::memcmp(file->data(), mark.data(), mark.size()) == 0 &&
                           header[0] == key_ && header[1] == count_;
  if (!is_the_same) return std::nullopt;
  const auto* const first = reinterpret_cast<const float*>(file->data() + header_bytes);
  return Column(file, first, count_);
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
  file.finish();
}

}  // namespace splotchcl
