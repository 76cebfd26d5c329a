#pragma once

#include <cstddef>
#include <memory>

#include "scene/particle_columns.h"
#include "splotchcl/communicator.h"
#include "splotchcl/snapshot.h"

// Who looks at which particles of a snapshot, where something follows from all of them.
namespace splotchcl {

// These ranks have all opened the same snapshot, and look at its particles together from now on:
// what decides or loads is collective, and suggest_scene within agree(). Null: nothing changes.
void share_passes(const Snapshot& snapshot, const std::shared_ptr<Communicator>& ranks);
bool has_shared_passes(const Snapshot& snapshot);

// Over the particles of one type: of a snapshot that ranks share equal runs, of particles that are
// spread over ranks each one's own, else all.
ParticlePass pass_over(const Snapshot& snapshot, int type);

// Over `count` particles that were made of the snapshot's and that this process can all read.
ParticlePass pass_over_made(const Snapshot& snapshot, std::size_t count);

}  // namespace splotchcl
