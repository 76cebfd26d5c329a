#include "between/id_match.h"

#include <algorithm>
#include <atomic>

#include "parallel/for_blocks.h"
#include "scene/ceil_divide.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

using Ids = std::vector<std::uint64_t>;

constexpr std::size_t ids_per_block = 65536;

struct IdPlace {
  std::uint64_t id;
  std::uint32_t place;
};

// Particles go into buckets by their ids, so that equal ids of both snapshots meet in one bucket,
// and buckets can be matched one by one, each in a core's nearest cache.
class Buckets {
 public:
  // 2^bits of them.
  Buckets(const Ids& ids, int bits) : bits_(bits), sorted_(ids.size()) {
    const std::size_t blocks = ceil_divide(ids.size(), ids_per_block);
    std::vector<std::size_t> begins(blocks * count());
    for_blocks(ids.size(), ids_per_block, [&](std::size_t begin, std::size_t end) {
      std::size_t* const of_block = begins.data() + begin / ids_per_block * count();
      for (std::size_t i = begin; i < end; ++i)
        ++of_block[bucket_of(ids[i])];
    });
    set_begins(begins, blocks);
    for_blocks(ids.size(), ids_per_block, [&](std::size_t begin, std::size_t end) {
      std::size_t* const next = begins.data() + begin / ids_per_block * count();
      for (std::size_t i = begin; i < end; ++i)
        sorted_[next[bucket_of(ids[i])]++] = {ids[i], static_cast<std::uint32_t>(i)};
    });
  }

  std::size_t count() const { return std::size_t{1} << bits_; }
  // Those of a bucket, by their ids.
  struct Range {
    IdPlace *begin, *end;
  };
  Range sort(std::size_t bucket) {
    const Range range = {sorted_.data() + begins_[bucket], sorted_.data() + begins_[bucket + 1]};
    std::sort(range.begin, range.end,
              [](const IdPlace& a, const IdPlace& b) { return a.id < b.id; });
    return range;
  }

 private:
  // Ids that follow each other, as most do, are spread evenly.
  std::size_t bucket_of(std::uint64_t id) const {
    return bits_ == 0 ? 0 : static_cast<std::size_t>(id * 0x9e3779b97f4a7c15u >> (64 - bits_));
  }

  // From how many of each bucket a block has to where it writes them.
  void set_begins(std::vector<std::size_t>& of_blocks, std::size_t blocks) {
    std::size_t total = 0;
    for (std::size_t bucket = 0; bucket < count(); ++bucket) {
      begins_.push_back(total);
      for (std::size_t block = 0; block < blocks; ++block) {
        std::size_t& entry = of_blocks[block * count() + bucket];
        const std::size_t found = entry;
        entry = total;
        total += found;
      }
    }
    begins_.push_back(total);
  }

  int bits_;
  std::vector<IdPlace> sorted_;
  std::vector<std::size_t> begins_;
};

// As few as keep a bucket to some ten thousand particles.
int bucket_bits(std::size_t particles) {
  int bits = 0;
  while (bits < 12 && (particles >> bits) > 16384)
    ++bits;
  return bits;
}

std::size_t run_length(const IdPlace* from, const IdPlace* end) {
  const IdPlace* last = from + 1;
  while (last < end && last->id == from->id)
    ++last;
  return static_cast<std::size_t>(last - from);
}

struct MatchedCounts {
  std::size_t in_common = 0, ambiguous = 0;
};

// Writes to each particle's own places alone.
MatchedCounts match_bucket(Buckets::Range a, Buckets::Range b, std::uint32_t* place_in_second,
                           std::uint8_t* appears) {
  MatchedCounts counts;
  while (a.begin < a.end || b.begin < b.end) {
    const bool takes_a = b.begin == b.end || (a.begin < a.end && a.begin->id <= b.begin->id);
    const bool takes_b = a.begin == a.end || (b.begin < b.end && b.begin->id <= a.begin->id);
    const std::size_t of_a = takes_a ? run_length(a.begin, a.end) : 0;
    const std::size_t of_b = takes_b ? run_length(b.begin, b.end) : 0;
    if (of_a == 1 && of_b == 1) {
      place_in_second[a.begin->place] = b.begin->place;
      ++counts.in_common;
    } else {
      for (std::size_t k = 0; k < of_b; ++k)
        appears[b.begin[k].place] = 1;
      counts.ambiguous += (of_a > 1 ? of_a : 0) + (of_b > 1 ? of_b : 0);
    }
    a.begin += of_a;
    b.begin += of_b;
  }
  return counts;
}

std::vector<std::uint32_t> places_of(const std::vector<std::uint8_t>& flags) {
  std::vector<std::uint32_t> places;
  for (std::size_t i = 0; i < flags.size(); ++i) {
    if (flags[i]) places.push_back(static_cast<std::uint32_t>(i));
  }
  return places;
}

}  // namespace

IdMatch match_ids(const Ids& first, const Ids& second) {
  if (std::max(first.size(), second.size()) >= IdMatch::nobody) {
    throw DataError(
        "snapshots are matched for up to 4 billion particles of a type; set time.interpolation to "
        "\"none\"");
  }
  const int bits = bucket_bits(std::max(first.size(), second.size()));
  Buckets a(first, bits), b(second, bits);
  IdMatch match;
  match.place_in_second.assign(first.size(), IdMatch::nobody);
  std::vector<std::uint8_t> appears(second.size(), 0);
  std::atomic<std::size_t> in_common{0}, ambiguous{0};
  for_blocks(a.count(), 1, [&](std::size_t bucket, std::size_t) {
    const MatchedCounts counts =
        match_bucket(a.sort(bucket), b.sort(bucket), match.place_in_second.data(), appears.data());
    in_common += counts.in_common;
    ambiguous += counts.ambiguous;
  });
  match.in_common = in_common;
  match.ambiguous = ambiguous;
  match.appearing = places_of(appears);
  return match;
}

}  // namespace splotchcl
