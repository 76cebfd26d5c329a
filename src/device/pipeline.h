#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "device/frame/chunks.h"
#include "device/frame/particle_store.h"
#include "device/frame/records.h"
#include "device/frame/stage_context.h"
#include "device/ranks/light_transfer.h"
#include "device/ranks/rank_work.h"
#include "device/ranks/slice_clouds.h"
#include "device/stages/binner.h"
#include "device/stages/certifier.h"
#include "device/stages/clouds_in_lists.h"
#include "device/stages/compositor.h"
#include "device/stages/projector.h"
#include "device/stages/resolver.h"
#include "device/stages/sorter.h"
#include "device/stages/surroundings.h"
#include "device/stages/window_projector.h"
#include "splotchcl/image.h"

namespace splotchcl {

class SplatExchange;
struct SlicePart;

struct DrawCounts {
  std::uint64_t particles = 0;  // in the components
  std::uint64_t visible = 0, bad = 0;
  std::uint64_t too_sharp = 0;        // for the plan's precision
  std::uint64_t around = 0;           // clouds around the camera
  std::uint64_t in_lists = 0;         // of those, entries of lists
  std::uint64_t blocks_left_out = 0;  // of particles, out of view
  std::uint64_t tile_entries = 0;     // splats summed over tiles
  std::uint64_t windows = 0;          // of an ordered frame that has no room in one piece
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
  // Of all splats that have been drawn; of ranks the first knows.
  CollectedSplats collected() const;
  const DrawCounts& counts() const { return counts_; }  // of what has been drawn, by all ranks

  const StageContext& context() const { return context_; }
  std::vector<ParticleChunk> particle_chunks() const;
  SplatBlocks project(const ParticleChunk& chunk);
  KeyedSplats project_all();
  const Projector& projector() const { return projector_; }
  const Sorter& sorter() const { return sorter_; }
  const Binner& binner() const { return binner_; }
  const Compositor& compositor() const { return compositor_; }
  const Resolver& resolver() const { return resolver_; }

 private:
  bool is_first() const { return ranks_ == nullptr || ranks_->rank() == 0; }
  Planes add_chunk(const ParticleChunk& chunk, Planes planes);
  std::vector<SplatLight> room_beside(std::size_t leaves) const;
  SplatLight draw_leaf(const std::vector<ParticleChunk>& chunks, const ChunkRange& leaf);
  Planes draw_sums();
  Planes draw_ordered(Planes planes);
  Planes draw_alone(Planes planes);  // an ordered frame, by this rank
  void take_counts(const ParticleCounts& found, std::uint64_t left_out);
  bool has_room_for_all_splats() const;
  Planes draw_windows(Planes planes);
  // Chunks of the order from `next` on that lie in `sorted`, whose first splat is number `first`.
  Planes draw_chunks(const SortedSplats& sorted, std::uint64_t first,
                     const std::vector<SplatChunk>& chunks, std::size_t& next, Planes planes);
  Planes draw_splats(const SortedSplats& sorted, const SplatChunk& chunk, Planes planes);
  Planes end_order(std::uint64_t splats, Planes planes);
  std::vector<CloudAround> find_around(const std::vector<ChunkBlocks>& chunks);
  std::vector<CloudAround> list_around(const std::vector<ChunkBlocks>& chunks,
                                       std::uint64_t counted);

  // Several ranks (pipeline_ranks.cpp).
  std::vector<CloudAround> gather_around(const std::vector<ChunkBlocks>& chunks, std::uint64_t own);
  void place_around(KeyedSplats& keyed, std::uint64_t first, const CloudRange& clouds);
  std::vector<CloudRange> slice_around(const std::vector<KeySlice>& slices) const;
  void add_up_counts();
  Planes draw_slices(Planes planes);
  SplatLight draw_slice(const SortedSplats& sorted, const SlicePart& part,
                        const std::vector<SplatChunk>& chunks, SplatLight light);
  SplatLight draw_slice_in_bands(const SortedSplats& sorted, const SlicePart& part,
                                 const std::vector<SplatChunk>& chunks, SplatLight light);
  Planes draw_lists(const CountedSplats& counted, const std::vector<TileBand>& bands,
                    Planes planes);
  void send_state(const SplatLight& light, int to);
  SplatLight receive_state(int from);
  void take_around(std::vector<CloudAround> clouds);
  // Puts clouds around the camera with keys below `end_key` among splats, the nearest of which is
  // number `first`, or finds their places between them.
  void place_around(KeyedSplats& keyed, std::uint64_t first, std::uint64_t end_key);
  void draw_around(const CloudLayer& layer, const Planes& planes);
  Planes draw_lists(const CountedSplats& counted, Planes planes);
  void tell(std::size_t done, std::size_t total) const;

  ParticleStore& particles_;
  const StageContext context_;
  const Projector projector_;
  const Sorter sorter_;
  const Binner binner_;
  Compositor compositor_;
  const Resolver resolver_;
  Certifier certifier_;
  SlabLight slab_light_;
  Buffer<float> deepest_;  // layers of the picture
  const Surroundings surroundings_;
  CloudsInLists in_lists_;  // clouds around the camera that are entries like splats ...
  CloudLayers around_;      // ... or layers between them
  std::vector<ChunkBlocks> chunks_with_around_;  // of sums
  DrawCounts counts_;
  std::function<void(double)> progress_;
  FrameRanks* ranks_;                      // null: one process
  std::optional<LightTransfer> transfer_;  // between ranks
};

}  // namespace splotchcl
