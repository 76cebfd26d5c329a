#include "scene/particle_pass.h"

#include <cstdint>

namespace splotchcl {
namespace {

using Bytes = PassRanks::Bytes;

// A rank's runs, behind the places in bytes where they end.
Bytes packed(const Bytes& runs, const std::vector<std::size_t>& ends) {
  std::vector<std::uint64_t> table(ends.begin(), ends.end());
  Bytes all(table.size() * sizeof(std::uint64_t) + runs.size());
  std::memcpy(all.data(), table.data(), table.size() * sizeof(std::uint64_t));
  if (!runs.empty())
    std::memcpy(all.data() + table.size() * sizeof(std::uint64_t), runs.data(), runs.size());
  return all;
}

struct PackedRuns {
  std::vector<std::uint64_t> ends;
  const std::byte* bytes;

  PackedRuns(const Bytes& all, std::size_t runs)
      : ends(runs), bytes(all.data() + runs * sizeof(std::uint64_t)) {
    std::memcpy(ends.data(), all.data(), runs * sizeof(std::uint64_t));
  }
  void append_run(std::size_t run, Bytes& to) const {
    to.insert(to.end(), bytes + (run == 0 ? 0 : ends[run - 1]), bytes + ends[run]);
  }
};

}  // namespace

Bytes ParticlePass::in_order(Bytes own, const std::vector<std::size_t>& ends) const {
  const std::vector<Bytes> all = ranks_->gather(packed(own, ends));
  own = {};
  std::vector<PackedRuns> ranks;
  std::size_t size = 0;
  for (const Bytes& of_rank : all) {
    ranks.emplace_back(of_rank, ends.size());
    size += of_rank.size() - ends.size() * sizeof(std::uint64_t);
  }
  Bytes joined;
  joined.reserve(size);
  for (std::size_t run = 0; run < ends.size(); ++run) {
    for (const PackedRuns& of_rank : ranks)
      of_rank.append_run(run, joined);
  }
  return joined;
}

}  // namespace splotchcl
