#include "load/missing_sizes.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "load/smoothing_length_cache.h"
#include "ranks/agreement.h"
#include "ranks/values.h"
#include "snapshot/load_memory.h"
#include "splotchcl/error.h"
#include "splotchcl/load.h"

namespace splotchcl {
namespace {

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

Column find_sizes_by_neighbors(const Snapshot& snapshot, int type, const Column& position,
                               const std::optional<BoxSides>& periodic_box, const MissingSizes& how,
                               const std::function<void(const std::string&)>& say) {
  const SnapshotInfo& info = snapshot.info();
  Communicator* const ranks = snapshot.memory().ranks().get();
  const auto find = [&] { return search(type, position, periodic_box, how, ranks); };
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

}  // namespace splotchcl
