#include "device/ranks/rank_share.h"

#include <algorithm>

namespace splotchcl {
namespace {

// The smallest number that is no less than count * part / parts.
std::size_t share_begin(std::size_t count, std::size_t part, std::size_t parts) {
  return (count * part + parts - 1) / parts;
}

}  // namespace

ChunkRange leaves_of_rank(std::size_t count, int rank, int ranks) {
  const auto part = static_cast<std::size_t>(rank), parts = static_cast<std::size_t>(ranks);
  return {share_begin(count, part, parts), share_begin(count, part + 1, parts)};
}

int owner_of_leaf(std::size_t leaf, std::size_t count, int ranks) {
  return static_cast<int>(leaf * static_cast<std::size_t>(ranks) / count);
}

std::vector<ParticleChunk> particles_of_rank(const Frame& frame, const DeviceTraits& traits,
                                             int rank, int ranks) {
  const std::uint64_t all = particle_count(frame);
  const auto part = static_cast<std::uint64_t>(rank), parts = static_cast<std::uint64_t>(ranks);
  const std::uint64_t begin = share_begin(all, part, parts),
                      end = share_begin(all, part + 1, parts);
  std::vector<ParticleChunk> chunks;
  std::uint64_t before = 0;  // particles of the components before
  for (std::uint32_t c = 0; c < frame.components.size(); ++c) {
    const std::uint64_t count = frame.components[c].particles.count;
    const auto place_of = [&](std::uint64_t border) {
      if (border >= before + count) return count;
      const std::uint64_t place = border > before ? border - before : 0;
      return place / traits.project_block * traits.project_block;
    };
    // Chunks end where those of one process do, so that columns in pieces have them whole.
    const std::uint64_t last = place_of(end), length = particles_per_chunk(count, traits);
    for (std::uint64_t first = place_of(begin); first < last;) {
      const std::uint64_t next = (first / length + 1) * length;
      chunks.push_back({c, first, std::min(next, last)});
      first = chunks.back().end;
    }
    before += count;
  }
  return chunks;
}

}  // namespace splotchcl
