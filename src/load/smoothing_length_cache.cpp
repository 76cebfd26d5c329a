#include "load/smoothing_length_cache.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "common/mapped_file.h"
#include "common/unfinished_file.h"

namespace splotchcl {
namespace {

// The file: this mark, key and count in the machine's own endianness, then the lengths.
constexpr std::array<char, 16> mark = {'s', 'p', 'l', 'o', 't', 'c',  'h', 'c',
                                       'l', ' ', 'h', ' ', '1', '\n', 0,   0};
constexpr std::size_t header_bytes = mark.size() + 2 * sizeof(std::uint64_t);

// Mixes numbers into one key (FNV-1a, word by word).
class Hash {
 public:
  void add(std::uint64_t word) { value_ = (value_ ^ word) * 0x100000001b3U; }
  void add(double number) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &number, sizeof bits);
    add(bits);
  }
  std::uint64_t value() const { return value_ ^ value_ >> 29; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

}  // namespace

SmoothingLengthCache::SmoothingLengthCache(const SnapshotInfo& info, int type,
                                           const Column& position,
                                           std::optional<double> periodic_box, int neighbors)
    : path_(info.files.front()), count_(position.size() / 3) {
  path_ += fmt::format(".type{}.smoothing_lengths", type);
  Hash hash;
  hash.add(static_cast<std::uint64_t>(neighbors));
  hash.add(periodic_box.value_or(0));
  hash.add(count_);
  for (std::size_t i = 0; i < position.size(); ++i) {
    std::uint32_t bits = 0;
    const float coordinate = position[i];
    std::memcpy(&bits, &coordinate, sizeof bits);
    hash.add(std::uint64_t{bits});
  }
  key_ = hash.value();
}

std::optional<Column> SmoothingLengthCache::read() const {
  std::error_code ignored;
  const bool has_length =
      std::filesystem::file_size(path_, ignored) == header_bytes + count_ * sizeof(float);
  if (!has_length) return std::nullopt;
  const auto file = MappedFile::open(path_);
  std::array<std::uint64_t, 2> header = {};
  std::memcpy(header.data(), file->data() + mark.size(), sizeof header);
  const bool is_the_same = std::memcmp(file->data(), mark.data(), mark.size()) == 0 &&
                           header[0] == key_ && header[1] == count_;
  if (!is_the_same) return std::nullopt;
  const auto* const first = reinterpret_cast<const float*>(file->data() + header_bytes);
  return Column(file, first, count_);
}

bool SmoothingLengthCache::is_in_the_way() const {
  std::error_code ignored;
  if (!std::filesystem::exists(path_, ignored)) return false;
  if (!std::filesystem::is_regular_file(path_, ignored)) return true;
  const auto file = MappedFile::open(path_);
  // A file of ours may have been cut.
  const auto there = static_cast<std::size_t>(std::min<std::uint64_t>(file->size(), mark.size()));
  return there > 0 && std::memcmp(file->data(), mark.data(), there) != 0;
}

void SmoothingLengthCache::write(const Column& lengths) const {
  UnfinishedFile file(path_);
  const std::array<std::uint64_t, 2> header = {key_, count_};
  file.write(mark.data(), mark.size());
  file.write(header.data(), sizeof header);
  file.write(lengths.data(), count_ * sizeof(float));
  file.finish();
}

}  // namespace splotchcl
