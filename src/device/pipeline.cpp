#include "device/pipeline.h"

#include <utility>

#include "device/frame/splat_capacity.h"
#include "device/ranks/leaf_sums.h"
#include "device/stages/carry_splats.h"
#include "device/stages/project_parameters.h"

namespace splotchcl {

Pipeline::Pipeline(DeviceContext& device, ParticleStore& particles, const Frame& frame,
                   const FramePlan& plan, std::function<void(double)> progress, FrameRanks* ranks)
    : particles_(particles),
      context_(device, frame, plan),
      projector_(context_),
      sorter_(device, plan.needs_sort()),
      binner_(context_),
      compositor_(context_),
      resolver_(context_),
      certifier_(context_),
      surroundings_(context_),
      progress_(std::move(progress)),
      ranks_(ranks) {
  if (ranks_ != nullptr) transfer_.emplace(context_, compositor_, *ranks_);
  // What all stages have asked for, before the device has work to do.
  device.programs.compile_all();
}

Image Pipeline::draw() {
  counts_ = {};
  around_ = {};
  in_lists_ = {};
  chunks_with_around_.clear();
  counts_.particles = particle_count(context_.frame);
  Planes planes = context_.plan.needs_sort() ? draw_ordered(compositor_.start()) : draw_sums();
  if (!is_first()) return Image(context_.frame.crop.width, context_.frame.crop.height);
  if (context_.plan.light != LightPlan::emission) {
    planes = resolver_.to_picture(std::move(planes));
    deepest_ = resolver_.find_deepest(planes);
  }
  return resolver_.resolve(std::move(planes));
}

CollectedSplats Pipeline::collected() const {
  CollectedSplats collected = certifier_.collected();
  if (context_.plan.slabs > 0) collected.of_slabs = resolver_.errors_of_slabs(slab_light_);
  if (context_.plan.light != LightPlan::emission)
    collected.depths = resolver_.depths_of_blocks(deepest_);
  if (counts_.around > 0) collected.around = Surroundings::share_of_promise;
  return collected;
}

std::vector<ParticleChunk> Pipeline::particle_chunks() const {
  return splotchcl::particle_chunks(context_.frame, context_.device.traits);
}

SplatBlocks Pipeline::project(const ParticleChunk& chunk) {
  return projector_.project(chunk, particles_in_view(context_, particles_, chunk));
}

KeyedSplats Pipeline::project_all() {
  std::vector<ParticleBuffers> buffers;
  for (std::uint32_t c = 0; c < context_.frame.components.size(); ++c) {
    const ParticleChunk all = {c, 0, context_.frame.components[c].particles.count};
    buffers.push_back(particles_in_view(context_, particles_, all));
  }
  return projector_.project_all(buffers);
}

// Order does not matter: particles pass through in chunks, and the working memory is a chunk's and
// that of a few sums, however many there are.
Planes Pipeline::draw_sums() {
  const std::vector<ParticleChunk> chunks = particle_chunks();
  const std::vector<ChunkRange> leaves = sum_leaves(chunks.size(), context_.device.traits);
  LeafSums sums(context_, leaves.size(), ranks_, transfer_ ? &*transfer_ : nullptr);
  std::vector<SplatLight> room = room_beside(sums.own_leaves());
  std::size_t drawn = 0;
  sums.draw([&](std::size_t leaf) {
    if (drawn++ > 0 && !room.empty()) room.pop_back();
    return draw_leaf(chunks, leaves[leaf]);
  });
  const std::uint64_t own_around = counts_.around;
  add_up_counts();
  if (leaves.empty() || counts_.too_sharp > 0) return compositor_.start();
  std::vector<CloudAround> around;
  if (counts_.around > 0)
    around = ranks_ == nullptr ? find_around(chunks_with_around_)
                               : gather_around(chunks_with_around_, own_around);
  SplatLight light = sums.join();
  certifier_.put_cells(std::move(light.cells));
  if (is_first()) surroundings_.draw(around, light.planes);
  return std::move(light.planes);
}

// Memory for the light that is held while leaves are drawn, before it is needed: taken between two
// leaves, it would cost the pool free memory that the next one uses again.
std::vector<SplatLight> Pipeline::room_beside(std::size_t leaves) const {
  std::vector<SplatLight> room;
  for (std::size_t held = 1; held < most_held_leaves(leaves); ++held)
    room.push_back({compositor_.room(), certifier_.room()});
  return room;
}

SplatLight Pipeline::draw_leaf(const std::vector<ParticleChunk>& chunks, const ChunkRange& leaf) {
  SplatLight light;
  light.planes = compositor_.start();
  for (std::size_t i = leaf.first; i < leaf.end && counts_.too_sharp == 0; ++i) {
    tell(i, chunks.size());
    light.planes = add_chunk(chunks[i], std::move(light.planes));
  }
  light.cells = certifier_.take_cells();
  return light;
}

std::vector<CloudAround> Pipeline::list_around(const std::vector<ChunkBlocks>& chunks,
                                               std::uint64_t counted) {
  const auto get = [this](const ParticleChunk& chunk) {
    return particles_in_view(context_, particles_, chunk);
  };
  return surroundings_.list(chunks, get, counted);
}

// Of an ordered frame.
void Pipeline::take_around(std::vector<CloudAround> clouds) {
  if (CloudsInLists::can_hold(context_, clouds)) {
    surroundings_.end_nearer(clouds);
    in_lists_ = CloudsInLists(context_, clouds);
    counts_.in_lists = clouds.size();
    compositor_.take_clouds(in_lists_.tables());
  } else {
    around_ = CloudLayers(std::move(clouds));
  }
}

std::vector<CloudAround> Pipeline::find_around(const std::vector<ChunkBlocks>& chunks) {
  std::vector<CloudAround> clouds = surroundings_.in_order(list_around(chunks, counts_.around));
  counts_.visible += clouds.size();
  return clouds;
}

Planes Pipeline::add_chunk(const ParticleChunk& chunk, Planes planes) {
  if (ranks_ != nullptr) ranks_->work.particles += chunk.count();
  SplatBlocks blocks = project(chunk);
  counts_.blocks_left_out += blocks.left_out;
  planes = draw_lists(binner_.count(blocks), std::move(planes));
  // Read last: the device has long counted them.
  const ParticleCounts particles = projector_.count(blocks, chunk);
  if (ranks_ != nullptr) ranks_->work.splats += particles.visible;
  counts_.visible += particles.visible;
  counts_.bad += particles.bad;
  counts_.too_sharp += particles.too_sharp;
  counts_.around += particles.around;
  if (particles.around > 0) {
    // While the device draws the chunk.
    if (chunks_with_around_.empty()) surroundings_.get_programs();
    chunks_with_around_.push_back(particles.chunks_around.front());
  }
  return planes;
}

bool Pipeline::has_room_for_all_splats() const {
  for (const DrawnComponent& component : context_.frame.components) {
    if (!particles_.are_whole(component.particles)) return false;
  }
  return splat_slots(context_.frame, context_.plan, context_.device.traits) <=
         splat_capacity(context_);
}

// Splats of the whole frame are sorted, then composited nearest first, chunk by chunk.
Planes Pipeline::draw_ordered(Planes planes) {
  return ranks_ != nullptr ? draw_slices(std::move(planes)) : draw_alone(std::move(planes));
}

void Pipeline::take_counts(const ParticleCounts& found, std::uint64_t left_out) {
  counts_.blocks_left_out = left_out;
  counts_.visible = found.visible;
  counts_.bad = found.bad;
  counts_.too_sharp = found.too_sharp;
  counts_.around = found.around;
}

Planes Pipeline::draw_alone(Planes planes) {
  if (!has_room_for_all_splats()) return draw_windows(std::move(planes));
  KeyedSplats keyed = project_all();
  take_counts(keyed.particles, keyed.left_out);
  if (counts_.too_sharp > 0) return planes;
  if (counts_.around > 0) take_around(find_around(keyed.particles.chunks_around));
  place_around(keyed, 0, end_of_keys);
  const SortedSplats sorted = sorter_.sort(std::move(keyed));
  const std::vector<SplatChunk> chunks =
      splat_chunks(sorted.count, context_.plan.slabs, context_.device.traits);
  if (context_.plan.slabs > 0) slab_light_ = resolver_.start_slabs();
  std::size_t next = 0;
  return end_order(sorted.count, draw_chunks(sorted, 0, chunks, next, std::move(planes)));
}

// The same chunks, of splats that are projected and sorted window by window: what a window has
// left of a chunk stands before the next one's.
Planes Pipeline::draw_windows(Planes planes) {
  WindowProjector windows(context_, projector_, sorter_, particles_);
  windows.count_keys();
  take_counts(windows.particles(), windows.left_out());
  counts_.windows = windows.steps();
  if (counts_.too_sharp > 0) return planes;
  const std::uint64_t without_clouds = counts_.visible;
  if (counts_.around > 0)
    take_around(find_around(all_blocks(particle_chunks(), context_.device.traits)));
  const std::uint64_t splats = without_clouds + in_lists_.count();
  const std::vector<SplatChunk> chunks =
      splat_chunks(splats, context_.plan.slabs, context_.device.traits);
  if (context_.plan.slabs > 0) slab_light_ = resolver_.start_slabs();
  SortedSplats sorted;
  std::uint64_t first = 0, drawn = 0;
  std::size_t next = 0;
  for (std::size_t step = 0; step < windows.steps(); ++step) {
    sorted = windows.next(
        step, std::move(sorted), static_cast<std::uint32_t>(drawn - first),
        {[&](std::uint64_t end_key) { return in_lists_.open_before(end_key); },
         [&](std::uint64_t end_key, KeyedSplats& keyed) { place_around(keyed, drawn, end_key); }});
    first = drawn;
    planes = draw_chunks(sorted, first, chunks, next, std::move(planes));
    drawn = next < chunks.size() ? chunks[next].first : splats;
  }
  return end_order(splats, std::move(planes));
}

Planes Pipeline::draw_chunks(const SortedSplats& sorted, std::uint64_t first,
                             const std::vector<SplatChunk>& chunks, std::size_t& next,
                             Planes planes) {
  for (; next < chunks.size(); ++next) {
    SplatChunk chunk = chunks[next];
    const std::uint64_t end = chunk.first + chunk.count;
    if (end - first > sorted.count) break;
    tell(next, chunks.size());
    // Clouds around the camera lie between splats. Slabs end there.
    while (const std::optional<CloudLayer> layer = around_.take_before(end)) {
      const auto before = static_cast<std::uint32_t>(layer->splats_before - chunk.first);
      planes = draw_splats(sorted, {chunk.first - first, before, true}, std::move(planes));
      draw_around(*layer, planes);
      chunk.first += before;
      chunk.count -= before;
    }
    chunk.first -= first;
    planes = draw_splats(sorted, chunk, std::move(planes));
  }
  return planes;
}

Planes Pipeline::draw_splats(const SortedSplats& sorted, const SplatChunk& chunk, Planes planes) {
  if (chunk.count > 0) planes = draw_lists(binner_.count(sorted, chunk), std::move(planes));
  if (context_.plan.slabs > 0 && chunk.ends_slab)
    planes = resolver_.lay_slab(std::move(planes), slab_light_);
  return planes;
}

// Clouds around the camera that lie behind all splats.
Planes Pipeline::end_order(std::uint64_t splats, Planes planes) {
  around_.place_among({}, splats, end_of_keys);
  while (const std::optional<CloudLayer> layer = around_.take_before(end_of_keys))
    draw_around(*layer, planes);
  return planes;
}

void Pipeline::place_around(KeyedSplats& keyed, std::uint64_t first, std::uint64_t end_key) {
  in_lists_.append_before(end_key, keyed);
  if (const std::optional<std::uint64_t> last = around_.last_open_before(end_key))
    around_.place_among(sort_keys_up_to(context_, keyed, *last), first, end_key);
}

void Pipeline::draw_around(const CloudLayer& layer, const Planes& planes) {
  surroundings_.draw(around_.clouds(), layer, planes);
  if (context_.plan.slabs > 0) resolver_.begin_slab(planes, slab_light_);
}

// Tiles do not depend on each other, so lists that do not fit together are made and drawn
// band by band of the picture, to the same bits.
Planes Pipeline::draw_lists(const CountedSplats& counted, Planes planes) {
  return draw_lists(counted, counted.bands, std::move(planes));
}

Planes Pipeline::draw_lists(const CountedSplats& counted, const std::vector<TileBand>& bands,
                            Planes planes) {
  for (const TileBand& band : bands) {
    const TileLists lists = binner_.make_lists(counted, band);
    counts_.tile_entries += lists.entry_count;
    certifier_.collect(lists);
    planes = compositor_.composite(lists, *counted.splats, std::move(planes));
  }
  return planes;
}

// The device has drawn all parts but the last: counting the splats of a part waits for those
// before.
void Pipeline::tell(std::size_t done, std::size_t total) const {
  if (progress_ && total > 1) progress_(static_cast<double>(done) / static_cast<double>(total));
}

}  // namespace splotchcl
