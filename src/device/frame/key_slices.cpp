#include "device/frame/key_slices.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace splotchcl {
namespace {

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

}  // namespace splotchcl
