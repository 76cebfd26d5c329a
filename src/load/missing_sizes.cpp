#include "load/missing_sizes.h"

#include <fmt/format.h>

#include "load/smoothing_length_cache.h"
#include "splotchcl/load.h"

namespace splotchcl {
namespace {

Column search(int type, const Column& position, std::optional<double> periodic_box,
              const MissingSizes& how) {
  Progress progress;
  if (how.progress) {
    progress = [&how, what = fmt::format("finding smoothing lengths of type {}", type)](
                   double fraction) { how.progress(what, fraction); };
  }
  return find_smoothing_lengths(position, position.size() / 3, periodic_box, how.neighbors,
                                progress);
}

}  // namespace

MissingSizes missing_sizes(const Scene& scene, const LoadProgress& progress) {
  return {scene.read.neighbors, scene.read.cache_smoothing_lengths, progress};
}

Column find_sizes_by_neighbors(const SnapshotInfo& info, int type, const Column& position,
                               std::optional<double> periodic_box, const MissingSizes& how,
                               const std::function<void(const std::string&)>& say) {
  if (!how.is_cached) return search(type, position, periodic_box, how);
  if (info.particles_per_drawn != 1) {
    say(
        fmt::format("the smoothing lengths of type {} are not kept: they are those of a part of "
                    "the particles",
                    type));
    return search(type, position, periodic_box, how);
  }
  const SmoothingLengthCache cache(info, type, position, periodic_box, how.neighbors);
  if (cache.is_in_the_way()) {
    say(fmt::format("the smoothing lengths of type {} are not kept: {} is another file; move it",
                    type, cache.path().string()));
    return search(type, position, periodic_box, how);
  }
  if (const auto kept = cache.read()) {
    say(fmt::format("the smoothing lengths of type {} are those kept in {}", type,
                    cache.path().string()));
    return *kept;
  }
  const Column found = search(type, position, periodic_box, how);
  cache.write(found);
  say(fmt::format("the smoothing lengths of type {} are kept in {}", type, cache.path().string()));
  return found;
}

}  // namespace splotchcl
