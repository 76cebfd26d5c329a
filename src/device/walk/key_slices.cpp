#include "device/walk/key_slices.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace splotchcl {
namespace {

KeyWindow window_of_bin(const CountedKeys& counted, std::size_t bin) {
  const std::uint64_t width = std::uint64_t{1} << counted.shift;
  // The counted keys agree in all bits above those that number the bins.
  const std::uint64_t upper = counted.window.first >> (counted.shift + bits_of_key_bin)
                                                          << (counted.shift + bits_of_key_bin);
  KeyWindow window;
  window.first = std::max(counted.window.first, upper + bin * width);
  window.end = std::min(counted.window.end, upper + (bin + 1) * width);
  window.splats = counted.bins[bin];
  return window;
}

// Splats that stay together, from this place on.
struct Piece {
  SplatPlace begin;
  std::uint64_t splats = 0;
};

class PieceFinder {
 public:
  PieceFinder(std::uint64_t most, const CountKeys& count, const CountChunks& count_chunks)
      : most_(most), count_(count), count_chunks_(count_chunks) {}

  void add(const CountedKeys& counted) {
    for (std::size_t bin = 0; bin < counted.bins.size(); ++bin) {
      if (counted.bins[bin] == 0) continue;
      const KeyWindow window = window_of_bin(counted, bin);
      if (window.splats <= most_) {
        pieces_.push_back({{window.first, 0}, window.splats});
      } else if (counted.shift > 0) {
        add(count_(window, counted.shift - bits_of_key_bin));
      } else {
        add_chunks(window);
      }
    }
  }

  std::vector<Piece> pieces() && { return std::move(pieces_); }

 private:
  void add_chunks(const KeyWindow& window) {
    const std::vector<std::uint64_t> chunks = count_chunks_(window);
    for (std::size_t chunk = 0; chunk < chunks.size(); ++chunk) {
      if (chunks[chunk] > 0) pieces_.push_back({{window.first, chunk}, chunks[chunk]});
    }
  }

  const std::uint64_t most_;
  const CountKeys& count_;
  const CountChunks& count_chunks_;
  std::vector<Piece> pieces_;
};

// `count` slices that end where they have their share of all splats.
std::vector<KeySlice> join(const std::vector<Piece>& pieces, std::uint64_t total,
                           std::size_t count) {
  std::vector<KeySlice> slices;
  std::uint64_t done = 0;
  auto next = pieces.begin();
  for (std::size_t s = 0; s < count; ++s) {
    KeySlice slice;
    slice.begin = next == pieces.end() ? SplatPlace{end_of_keys, 0} : next->begin;
    slice.first = done;
    const auto wanted = static_cast<std::uint64_t>(static_cast<long double>(total) *
                                                   static_cast<long double>(s + 1) /
                                                   static_cast<long double>(count));
    for (; next != pieces.end() && (done < wanted || s + 1 == count); ++next) {
      slice.splats += next->splats;
      done += next->splats;
    }
    slice.end = next == pieces.end() ? SplatPlace{end_of_keys, 0} : next->begin;
    slices.push_back(slice);
  }
  return slices;
}

// The first chunk that ends behind this splat: of splats before it nothing is left over in others.
std::size_t chunk_at(std::uint64_t splat, const std::vector<SplatChunk>& chunks) {
  const auto found = std::upper_bound(chunks.begin(), chunks.end(), splat,
                                      [](std::uint64_t place, const SplatChunk& chunk) {
                                        return place < chunk.first + chunk.count;
                                      });
  return static_cast<std::size_t>(found - chunks.begin());
}

}  // namespace

std::size_t slice_of(const SplatPlace& place, const KeySlice* slices, std::size_t count) {
  const KeySlice* const behind = std::upper_bound(
      slices, slices + count, place,
      [](const SplatPlace& at, const KeySlice& slice) { return at < slice.begin; });
  if (behind == slices || !(place < (behind - 1)->end)) return count;
  return static_cast<std::size_t>(behind - 1 - slices);
}

KeyWindow window_of(const KeySlice* slices, std::size_t count) {
  KeyWindow window;
  const SplatPlace& end = slices[count - 1].end;
  window.first = slices[0].begin.key;
  window.end = end.chunk > 0 ? end.key + 1 : end.key;
  window.splats =
      std::accumulate(slices, slices + count, std::uint64_t{0},
                      [](std::uint64_t sum, const KeySlice& slice) { return sum + slice.splats; });
  return window;
}

KeyWindow window_of_chunk(const KeySlice& slice, std::uint64_t chunk) {
  KeyWindow window;
  window.first = slice.begin.key + (chunk < slice.begin.chunk ? 1 : 0);
  window.end = slice.end.key + (chunk < slice.end.chunk ? 1 : 0);
  return window;
}

std::vector<KeySlice> cut_in_slices(const CountedKeys& counted, std::size_t ranks,
                                    std::uint64_t capacity, const CountKeys& count,
                                    const CountChunks& count_chunks) {
  const std::uint64_t total =
      std::accumulate(counted.bins.begin(), counted.bins.end(), std::uint64_t{0});
  // To be shared out evenly what stays together must be less than a share; what is no more than
  // half of a rank's room fills it.
  const std::uint64_t most =
      std::max<std::uint64_t>(1, std::min(capacity / 2, total / (2 * ranks)));
  PieceFinder finder(most, count, count_chunks);
  finder.add(counted);
  const std::vector<Piece> pieces = std::move(finder).pieces();
  for (std::size_t rounds = 1;; ++rounds) {
    std::vector<KeySlice> slices = join(pieces, total, ranks * rounds);
    const bool have_room =
        std::all_of(slices.begin(), slices.end(),
                    [capacity](const KeySlice& slice) { return slice.splats <= capacity; });
    if (have_room || ranks * rounds >= pieces.size()) return slices;
  }
}

SlicePart part_of(const KeySlice& slice, const std::vector<SplatChunk>& chunks) {
  const std::uint64_t end = slice.first + slice.splats;
  const auto first_of = [&](std::size_t chunk, std::uint64_t if_behind_all) {
    return chunk < chunks.size() ? chunks[chunk].first : if_behind_all;
  };
  SlicePart part;
  part.first_chunk = chunk_at(slice.first, chunks);
  part.end_chunk = chunk_at(end, chunks);
  part.first = first_of(part.first_chunk, slice.first);
  part.carried = static_cast<std::uint32_t>(slice.first - part.first);
  part.own = static_cast<std::uint32_t>(slice.splats);
  part.passed_on = static_cast<std::uint32_t>(end - first_of(part.end_chunk, end));
  return part;
}

std::vector<CloudRange> clouds_of_slices(const std::vector<std::uint64_t>& keys,
                                         const std::vector<KeySlice>& slices) {
  const auto lies_before = [](std::uint64_t key, const SplatPlace& place) {
    return SplatPlace{key, std::numeric_limits<std::uint64_t>::max()} < place;
  };
  std::vector<CloudRange> ranges;
  std::size_t first = 0;  // also of clouds nearer than all splats
  for (std::size_t s = 0; s < slices.size(); ++s) {
    const auto end = s + 1 < slices.size() ? std::lower_bound(keys.begin(), keys.end(),
                                                              slices[s + 1].begin, lies_before)
                                           : keys.end();
    ranges.push_back({first, static_cast<std::size_t>(end - keys.begin())});
    first = ranges.back().end;
  }
  return ranges;
}

KeySlice with_clouds(KeySlice slice, const CloudRange& clouds) {
  slice.first += clouds.first;
  slice.splats += clouds.end - clouds.first;
  return slice;
}

}  // namespace splotchcl
