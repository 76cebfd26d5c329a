#include "device/ranks/rank_share.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "device/frame/chunks.h"
#include "ranks/spread_particles.h"
#include "scene/particle_columns.h"

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

namespace {

std::vector<ParticleChunk> chunks_of_leaves(const Frame& frame, const DeviceTraits& traits,
                                            const Communicator& ranks) {
  const std::vector<ParticleChunk> chunks = particle_chunks(frame, traits);
  const std::vector<ChunkRange> leaves = sum_leaves(chunks.size(), traits);
  const ChunkRange own = leaves_of_rank(leaves.size(), ranks.rank(), ranks.size());
  std::vector<ParticleChunk> all;
  for (std::size_t leaf = own.first; leaf < own.end; ++leaf) {
    for (std::size_t chunk = leaves[leaf].first; chunk < leaves[leaf].end; ++chunk)
      all.push_back(chunks[chunk]);
  }
  return all;
}

void ask_for(const Column& column, std::size_t particles, const ParticleChunk& chunk,
             std::vector<float>& values) {
  if (!is_streamed(column) || particles == 0) return;
  const std::size_t width = column.size() / particles;
  const auto begin = static_cast<std::size_t>(chunk.first) * width,
             end = static_cast<std::size_t>(chunk.end) * width;
  values.resize(std::max(values.size(), end - begin));
  column.source()->make(begin, end, values.data());
}

}  // namespace

FetchedParticles::FetchedParticles(const Frame& frame, const FramePlan& plan,
                                   const DeviceTraits& traits)
    : spread_(frame.spread) {
  if (!spread_) return;
  const Communicator& ranks = spread_->ranks();
  const std::vector<ParticleChunk> chunks =
      plan.needs_sort() ? particles_of_rank(frame, traits, ranks.rank(), ranks.size())
                        : chunks_of_leaves(frame, traits, ranks);
  spread_->fetch([&] {
    std::vector<float> values;
    for (const ParticleChunk& chunk : chunks) {
      const Particles& particles = frame.components[chunk.component].particles;
      for (const Column* const column : particles.columns())
        ask_for(*column, particles.count, chunk, values);
    }
  });
}

FetchedParticles::~FetchedParticles() {
  if (spread_) spread_->forget();
}

}  // namespace splotchcl
