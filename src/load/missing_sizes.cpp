#include "load/missing_sizes.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/mapped_file.h"
#include "common/unfinished_file.h"
#include "ranks/exchange.h"
#include "scene/hash.h"
#include "scene/particle_columns.h"
#include "smoothing/smoothing_lengths.h"
#include "snapshot/load_memory.h"
#include "splotchcl/error.h"
#include "splotchcl/load.h"
#include "splotchcl/particles.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {
namespace {

// Smoothing lengths that were found, kept in a file beside the snapshot: for the first of its
// files, snapshot_006.type1.smoothing_lengths. It is used only where everything that they follow
// from is the same: positions, box and number of neighbours.
class SmoothingLengthCache {
 public:
  // `key` stands for all that lengths of `count` particles follow from.
  SmoothingLengthCache(const SnapshotInfo& info, int type, std::size_t count, std::uint64_t key);
  static std::uint64_t key_of(const Column& position, const std::optional<BoxSides>& periodic_box,
                              int neighbors);

  const std::filesystem::path& path() const { return path_; }

  // None where there is no such file, or it is of other positions or damaged.
  std::optional<Column> read() const;

  // Whether a file of this name is anything else, which is not overwritten.
  bool is_in_the_way() const;

  // Throws DataError when the file cannot be written.
  void write(const Column& lengths) const;

 private:
  std::filesystem::path path_;
  std::uint64_t key_ = 0;
  std::uint64_t count_ = 0;
};

// The file: this mark, key and count in the machine's own endianness, then the lengths and their
// checksum.
constexpr FileMark mark = {'s', 'p', 'l', 'o', 't', 'c',  'h', 'c',
                           'l', ' ', 'h', ' ', '1', '\n', 0,   0};
constexpr std::size_t header_bytes = mark.size() + 2 * sizeof(std::uint64_t);
constexpr std::size_t checksum_bytes = sizeof(std::uint64_t);

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
  for_stretches(position.size(), [&](std::size_t begin, std::size_t end) {
    const ColumnStretch stretch(position, begin, end);
    for (std::size_t i = begin; i < end; ++i) {
      std::uint32_t bits = 0;
      const float coordinate = stretch[i];
      std::memcpy(&bits, &coordinate, sizeof bits);
      hash.add(std::uint64_t{bits});
    }
  });
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

Column search(int type, const Column& position, const std::optional<BoxSides>& periodic_box,
              const MissingSizes& how, Communicator* ranks) {
  Progress progress;
  if (how.progress) {
    progress = [&how, what = fmt::format("finding smoothing lengths of type {}", type)](
                   double fraction) { how.progress(what, fraction); };
  }
  return find_smoothing_lengths(position, position.size() / 3, periodic_box, how.neighbors,
                                progress, search_share(ranks));
}

bool is_first(const Communicator* ranks) {
  return ranks == nullptr || ranks->rank() == 0;
}

// Of several ranks the first reads the positions that the key stands for.
SmoothingLengthCache cache_of(const SnapshotInfo& info, int type, const Column& position,
                              const std::optional<BoxSides>& periodic_box, int neighbors,
                              Communicator* ranks) {
  std::uint64_t key = 0;
  if (is_first(ranks)) key = SmoothingLengthCache::key_of(position, periodic_box, neighbors);
  if (ranks != nullptr) {
    wait_for_all(*ranks);
    broadcast_value(*ranks, key);
  }
  return SmoothingLengthCache(info, type, position.size() / 3, key);
}

// How many ranks say so; files may be seen by some of them.
std::uint64_t count_ranks(Communicator* ranks, bool own) {
  std::vector<std::uint64_t> count = {own ? 1u : 0u};
  if (ranks != nullptr) {
    wait_for_all(*ranks);
    ranks->add_up(count);
  }
  return count.front();
}

// Says whether they are. A full disk must not cost the search, which may have taken long.
std::string keep(const Column& lengths, const SmoothingLengthCache& cache) {
  try {
    cache.write(lengths);
  } catch (const Error& error) {
    return fmt::format("not kept: {}", error.what());
  }
  return "kept in " + cache.path().string();
}

}  // namespace

MissingSizes missing_sizes(const Scene& scene, const LoadProgress& progress) {
  return {scene.read.neighbors, scene.read.cache_smoothing_lengths, progress};
}

SearchShare search_share(Communicator* ranks) {
  if (ranks == nullptr) return {};
  return {ranks->rank(), ranks->size(),
          [ranks](std::vector<float>& values, const std::vector<std::size_t>& begins) {
            wait_for_all(*ranks);
            join_stretches(*ranks, values, begins);
          }};
}

namespace {

struct FoundSizes {
  std::uint64_t key = 0;  // stands for the positions
  Column lengths;
};

// Arrays may hold other values for every picture, but mostly have the same: the last search is kept
// with what it was made of.
Column find_sizes_once(const Snapshot& snapshot, int type, const Column& position,
                       const std::optional<BoxSides>& periodic_box, const MissingSizes& how) {
  using Kept = std::shared_ptr<FoundSizes>;
  const Kept& kept = snapshot.memory().get_for_all_times<Kept>(
      fmt::format("sizes of type {}", type), [] { return std::make_shared<FoundSizes>(); });
  const std::uint64_t key = SmoothingLengthCache::key_of(position, periodic_box, how.neighbors);
  if (kept->lengths.is_absent() || kept->key != key)
    *kept = {key, search(type, position, periodic_box, how, nullptr)};
  return kept->lengths;
}

}  // namespace

Column find_sizes_by_neighbors(const Snapshot& snapshot, int type, const Column& position,
                               const std::optional<BoxSides>& periodic_box, const MissingSizes& how,
                               const std::function<void(const std::string&)>& say) {
  const SnapshotInfo& info = snapshot.info();
  Communicator* const ranks = snapshot.memory().ranks().get();
  const bool is_of_arrays = info.files_mark == 0;
  const auto find = [&] {
    return is_of_arrays && ranks == nullptr
               ? find_sizes_once(snapshot, type, position, periodic_box, how)
               : search(type, position, periodic_box, how, ranks);
  };
  if (!how.is_cached) return find();
  if (!info.is_whole()) {
    say(
        fmt::format("the smoothing lengths of type {} are not kept: they are those of a part of "
                    "the particles",
                    type));
    return find();
  }
  const SmoothingLengthCache cache =
      cache_of(info, type, position, periodic_box, how.neighbors, ranks);
  if (count_ranks(ranks, cache.is_in_the_way()) > 0) {
    say(fmt::format("the smoothing lengths of type {} are not kept: {} is another file; move it",
                    type, cache.path().string()));
    return find();
  }
  const std::optional<Column> kept = cache.read();
  const std::uint64_t all = ranks != nullptr ? static_cast<std::uint64_t>(ranks->size()) : 1;
  if (count_ranks(ranks, kept.has_value()) == all) {
    say(fmt::format("the smoothing lengths of type {} are those kept in {}", type,
                    cache.path().string()));
    return *kept;
  }
  const Column found = find();
  if (is_first(ranks))
    say(fmt::format("the smoothing lengths of type {} are {}", type, keep(found, cache)));
  return found;
}

namespace {

// In the memory of each rank.
Column held(const Column& column) {
  std::vector<float> values(column.size());
  for_stretches(values.size(), [&](std::size_t begin, std::size_t end) {
    column.source()->make(begin, end, values.data() + begin);
  });
  return Column::owning(std::move(values));
}

}  // namespace

Column find_spread_sizes(SpreadParticles& spread, int type, const Column& own_position,
                         std::uint64_t first, const MissingSizes& how,
                         const std::optional<BoxSides>& periodic_box) {
  const std::size_t own_count = own_position.size() / 3;
  const Column of_all = spread.spread(own_position, own_count, 3);
  const std::size_t count = of_all.size() / 3;
  if (count > most_spread_neighbors) {
    throw DataError(fmt::format(
        "found {} particles of type {} without smoothing lengths, expected at most {} for a search "
        "of neighbours among particles that are spread over processes, which each of them holds; "
        "set the field smoothing_length, or density and mass, or size.fixed",
        count, type, most_spread_neighbors));
  }
  const Column position = held(of_all);
  const Column lengths = find_smoothing_lengths(position, count, periodic_box, how.neighbors, {},
                                                search_share(&spread.ranks()));
  const auto begin = static_cast<std::size_t>(first);
  std::vector<float> own(own_count);
  for (std::size_t i = 0; i < own_count; ++i)
    own[i] = lengths[begin + i];
  return Column::owning(std::move(own));
}

}  // namespace splotchcl
