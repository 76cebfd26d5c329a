#include "load/passes.h"

#include "ranks/spread_particles.h"
#include "snapshot/load_memory.h"

namespace splotchcl {
namespace {

std::size_t count_of(const Snapshot& snapshot, int type) {
  const ParticleTypeInfo* const info = snapshot.info().find_type(type);
  return info == nullptr ? 0 : static_cast<std::size_t>(info->count);
}

}  // namespace

void share_passes(const Snapshot& snapshot, const std::shared_ptr<Communicator>& ranks) {
  if (ranks && ranks->size() > 1) snapshot.memory().set_ranks(ranks);
}

bool has_shared_passes(const Snapshot& snapshot) {
  return snapshot.memory().ranks() != nullptr;
}

ParticlePass pass_over(const Snapshot& snapshot, int type) {
  const auto spread = snapshot.spread();
  if (!spread) return pass_over_made(snapshot, count_of(snapshot, type));
  const Snapshot& own = snapshot.own_part();
  const bool is_whole = &own != &snapshot;
  const std::size_t begin =
      is_whole ? static_cast<std::size_t>(own.place_in_file(type, 0)) : std::size_t{0};
  return ParticlePass({{begin, begin + count_of(own, type)}},
                      std::make_shared<const RankPass>(spread));
}

ParticlePass pass_over_made(const Snapshot& snapshot, std::size_t count) {
  return shared_pass(snapshot.memory().ranks(), count);
}

}  // namespace splotchcl
