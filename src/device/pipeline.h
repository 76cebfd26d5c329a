#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "device/frame/chunks.h"
#include "device/frame/particle_store.h"
#include "device/frame/records.h"
#include "device/frame/stage_context.h"
#include "device/ranks/rank_share.h"
#include "device/ranks/transfers.h"
#include "device/stages/binner.h"
#include "device/stages/certifier.h"
#include "device/stages/clouds_in_lists.h"
#include "device/stages/compositor.h"
#include "device/stages/project_parameters.h"
#include "device/stages/projector.h"
#include "device/stages/resolver.h"
#include "device/stages/sorter.h"
#include "device/stages/surroundings.h"
#include "device/walk/key_slices.h"
#include "device/walk/relay.h"
#include "device/walk/splat_slices.h"
#include "splotchcl/image.h"

namespace splotchcl {

struct DrawCounts : ParticleCounts {
  std::uint64_t particles = 0;        // in the components
  std::uint64_t in_lists = 0;         // of clouds around the camera, entries of lists
  std::uint64_t blocks_left_out = 0;  // of particles, out of view
  std::uint64_t tile_entries = 0;     // splats summed over tiles
  std::uint64_t windows = 0;          // slices of an ordered frame that has no room in one piece
};

// What the check of a frame goes by, as the device has collected it.
struct ReadSplats {
  CollectedSplats others;  // without cells
  CellsOfTiles cells;

  CollectedSplats gathered() const {
    CollectedSplats splats = others;
    cells.gather(splats);
    return splats;
  }
};

// The stages of one frame, from particles to the picture. The renderer draws with it; tests
// and benchmarks run its stages one by one.
class Pipeline {
 public:
  // All of them outlive the pipeline. The device's shape is that of its traits. `progress` as in
  // RendererOptions. `ranks` draw the frame together, with the same plan; null: one process does.
  Pipeline(DeviceContext& device, ParticleStore& particles, const Frame& frame,
           const FramePlan& plan, std::function<void(double)> progress = {},
           FrameRanks* ranks = nullptr);
  // It goes on reading the plan, which one that ends with the call would not let it.
  Pipeline(DeviceContext& device, ParticleStore& particles, const Frame& frame, FramePlan&& plan,
           std::function<void(double)> progress = {}, FrameRanks* ranks = nullptr) = delete;
  Pipeline(const Pipeline&) = delete;
  Pipeline& operator=(const Pipeline&) = delete;

  // Of no use where counts() tells of particles that are too sharp: it ends early then. Of ranks
  // the first has the picture, the others a black one.
  Image draw();
  // Of all splats that have been drawn; of ranks the first knows. What was read outlives the
  // pipeline, and is gathered without the device.
  ReadSplats read_collected() const;
  CollectedSplats collected() const { return read_collected().gathered(); }
  const DrawCounts& counts() const { return counts_; }  // of what has been drawn, by all ranks

  const StageContext& context() const { return context_; }
  std::vector<ParticleChunk> particle_chunks() const {
    return splotchcl::particle_chunks(context_.frame, context_.device.traits);
  }
  SplatBlocks project(const ParticleChunk& chunk) {
    return projector_.project(chunk, particles_in_view(context_, particles_, chunk));
  }
  KeyedSplats project_all() { return project_whole(context_, projector_, particles_); }
  const Projector& projector() const { return projector_; }
  const Sorter& sorter() const { return sorter_; }
  const Binner& binner() const { return binner_; }
  const Compositor& compositor() const { return compositor_; }
  const Resolver& resolver() const { return resolver_; }

 private:
  bool is_first() const { return ranks_.rank() == 0; }

  // A sum: leaf by leaf of a tree, chunk by chunk of the particles.
  SplatLight draw_sums();
  std::vector<SplatLight> room_beside(std::size_t leaves) const;
  SplatLight draw_leaf(const std::vector<ParticleChunk>& chunks, const ChunkRange& leaf);
  void add_chunk(const ParticleChunk& chunk, SplatLight& light);

  // An ordered frame: slice by slice of the order, chunk by chunk of the splats.
  struct Order;
  SplatLight draw_ordered();
  void draw_slice(std::size_t round, Order& order, SplatLight& light);
  void draw_chunks(const SortedSplats& sorted, const SlicePart& part, const Order& order,
                   SplatLight& light);
  void draw_bands(const SortedSplats& sorted, const SlicePart& part, const Order& order,
                  SplatLight& light);
  void draw_splats(const SortedSplats& sorted, const SplatChunk& chunk, SplatLight& light);
  void draw_lists(const CountedSplats& counted, const std::vector<TileBand>& bands,
                  SplatLight& light);

  // Clouds around the camera.
  std::vector<CloudAround> find_around(const std::vector<ChunkBlocks>& own_blocks,
                                       std::uint64_t own);
  void take_around(std::vector<CloudAround> clouds);
  std::vector<CloudRange> slice_around(const std::vector<KeySlice>& slices) const;
  // Puts these clouds among the splats of a slice, the nearest of which is number `first`, or finds
  // their places between them.
  void place_around(KeyedSplats& keyed, std::uint64_t first, const CloudRange& clouds);
  void draw_around(const CloudLayer& layer, const SplatLight& light);

  void take_counts(const SplatSlices& slices);
  void tell(std::size_t done, std::size_t total) const;

  ParticleStore& particles_;
  const StageContext context_;
  const Projector projector_;
  const Sorter sorter_;
  const Binner binner_;
  Compositor compositor_;
  const Resolver resolver_;
  const Certifier certifier_;
  // Of the last picture: what the check needs.
  Buffer<float> cells_, deepest_;
  SlabLight slab_light_;
  const Surroundings surroundings_;
  CloudsInLists in_lists_;  // clouds around the camera that are entries like splats ...
  CloudLayers around_;      // ... or layers between them
  DrawCounts counts_;
  std::function<void(double)> progress_;
  LoneRank alone_;
  FrameRanks one_process_{alone_, {}};
  FrameRanks& ranks_;
  const LightTransfer transfer_;  // between ranks
};

}  // namespace splotchcl
