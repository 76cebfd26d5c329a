#include "device/ranks/fetch_particles.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "device/frame/chunks.h"
#include "device/ranks/rank_share.h"
#include "ranks/spread_particles.h"
#include "scene/particle_columns.h"

namespace splotchcl {
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

// The stretch of a column that belongs to a chunk.
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
