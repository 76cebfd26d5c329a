#include "ranks/rank_pass.h"

#include "ranks/exchange.h"

namespace splotchcl {

std::vector<PassRanks::Bytes> RankPass::gather(const Bytes& own) const {
  Communicator& ranks = ranks_ ? *ranks_ : spread_->ranks();
  wait_for_all(ranks);
  std::vector<Bytes> all(static_cast<std::size_t>(ranks.size()));
  all[static_cast<std::size_t>(ranks.rank())] = own;
  // One after the other: a gathering is for little.
  for (int rank = 0; rank < ranks.size(); ++rank)
    broadcast_values(ranks, all[static_cast<std::size_t>(rank)], rank);
  return all;
}

void RankPass::begin_own() const {
  if (spread_) spread_->begin_own();
}

void RankPass::end_own() const {
  if (spread_) spread_->end_own();
}

ParticlePass shared_pass(const std::shared_ptr<Communicator>& ranks, std::size_t count) {
  if (!ranks) return ParticlePass(count);
  const auto border = [&](int rank) {
    return static_cast<std::size_t>(std::uint64_t{count} * static_cast<std::uint64_t>(rank) /
                                    static_cast<std::uint64_t>(ranks->size()));
  };
  const int rank = ranks->rank();
  return ParticlePass({{border(rank), border(rank + 1)}}, std::make_shared<const RankPass>(ranks));
}

}  // namespace splotchcl
