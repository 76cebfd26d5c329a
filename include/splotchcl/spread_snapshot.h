#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "splotchcl/array_snapshot.h"
#include "splotchcl/communicator.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// A simulation's particles that are spread over its ranks: each has its own in an ArraySnapshot.
// Together they are one snapshot, which has for each type rank 0's particles, then rank 1's, and so
// on. decide, load_frame and FrameDrawer take it; the pictures have the bits that one process
// draws from all arrays put together, however the particles are spread.
//
// What is decided (cameras, ranges, reference columns) is decided from all particles, alike on all
// ranks: each looks at its own, and all are told what any has found. A plan follows from a sample,
// which all see. For drawing each rank is given its part of the work, about a part in size() of the
// particles, whoever has them. Where smoothing lengths have to be found from neighbours, each holds
// the positions of all particles of the type while it searches, of at most 2^24 (docs/large.md).
//
// All ranks make the same calls with the same scene, which are collective. Where a call fails on
// one of them before drawing begins, it fails on all: one throws what happened, the others
// FailedElsewhere. What fails on one rank while all draw (its device, its memory) ends all
// processes, with one line on standard error: nobody could tell those that wait for it.
class SpreadSnapshot : public Snapshot {
 public:
  // Collective. `own` outlives the snapshot. Throws UsageError, agreed upon, where the ranks' parts
  // do not fit together: a type must have the same fields and the same mass for all on all ranks
  // that have particles of it (those without need not set them), and box size, time and origin of
  // positions must be the same everywhere.
  SpreadSnapshot(const ArraySnapshot& own, std::shared_ptr<Communicator> ranks);
  ~SpreadSnapshot() override;
  SpreadSnapshot(const SpreadSnapshot&) = delete;
  SpreadSnapshot& operator=(const SpreadSnapshot&) = delete;

  // Collective: what the arrays hold, or how many particles a rank has, has changed on some rank.
  // Throws as the constructor does.
  void changed();

  // Of all ranks together.
  const SnapshotInfo& info() const override { return info_; }
  // Of all ranks together, fetched when it is asked for. Collective, and so is asking for values.
  Column read(int type, const std::string& field) const override;
  Vec3 position_origin() const override { return own_.position_origin(); }
  std::shared_ptr<SpreadParticles> spread() const override { return spread_; }
  const Snapshot& own_part() const override;

 private:
  class OwnPart;

  const ArraySnapshot& own_;
  std::shared_ptr<Communicator> ranks_;
  std::shared_ptr<SpreadParticles> spread_;  // null: one rank, which has all
  SnapshotInfo info_;
  std::unique_ptr<OwnPart> own_part_;
};

}  // namespace splotchcl
