#pragma once

#include <memory>
#include <vector>

#include "ranks/spread_particles.h"
#include "scene/particle_pass.h"
#include "splotchcl/communicator.h"

namespace splotchcl {

// Ranks of a communicator that make a pass together, within agree(): where one of them fails, the
// others do not wait for what it would have found.
class RankPass final : public PassRanks {
 public:
  // Of particles that all ranks can read.
  explicit RankPass(std::shared_ptr<Communicator> ranks) : ranks_(std::move(ranks)) {}
  // Of particles of which each rank has its own.
  explicit RankPass(std::shared_ptr<SpreadParticles> spread) : spread_(std::move(spread)) {}

  std::vector<Bytes> gather(const Bytes& own) const override;
  void begin_own() const override;
  void end_own() const override;

 private:
  std::shared_ptr<Communicator> ranks_;  // one of both
  std::shared_ptr<SpreadParticles> spread_;
};

// Equal runs of `count` particles that all ranks can read; all of them for this process alone where
// `ranks` is null.
ParticlePass shared_pass(const std::shared_ptr<Communicator>& ranks, std::size_t count);

}  // namespace splotchcl
