#include "device/pipeline.h"

#include <utility>

#include "certificate/certificate.h"
#include "device/ranks/transfers.h"
#include "device/stages/project_parameters.h"
#include "device/walk/leaf_sums.h"
#include "ranks/exchange.h"

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
      ranks_(ranks != nullptr ? *ranks : one_process_),
      transfer_(context_, compositor_, ranks_) {
  // What all stages have asked for, before the device has work to do.
  device.programs.compile_all();
}

Image Pipeline::draw() {
  counts_ = {};
  around_ = {};
  in_lists_ = {};
  counts_.particles = particle_count(context_.frame);
  SplatLight light = context_.plan.needs_sort() ? draw_ordered() : draw_sums();
  Planes planes = std::move(light.planes);
  cells_ = std::move(light.cells);
  slab_light_ = std::move(light.slab);
  if (!is_first()) return Image(context_.frame.crop.width, context_.frame.crop.height);
  if (needs_depths(context_.frame, context_.plan)) {
    planes = resolver_.to_picture(std::move(planes));
    deepest_ = resolver_.find_deepest(planes);
  }
  return resolver_.resolve(std::move(planes));
}

ReadSplats Pipeline::read_collected() const {
  ReadSplats read;
  read.cells = certifier_.read(cells_);
  CollectedSplats& collected = read.others;
  if (context_.plan.slabs > 0) collected.of_slabs = resolver_.errors_of_slabs(slab_light_);
  if (needs_depths(context_.frame, context_.plan))
    collected.depths = resolver_.depths_of_blocks(deepest_);
  if (counts_.around > 0) collected.around = Surroundings::share_of_promise;
  return read;
}

// Order does not matter: particles pass through in chunks, and the working memory is a chunk's and
// that of a few sums, however many there are.
SplatLight Pipeline::draw_sums() {
  const std::vector<ParticleChunk> chunks = particle_chunks();
  const std::vector<ChunkRange> leaves = sum_leaves(chunks.size(), context_.device.traits);
  LeafSums sums(context_, leaves.size(), ranks_, transfer_);
  std::vector<SplatLight> room = room_beside(sums.own_leaves());
  std::size_t drawn = 0;
  sums.draw([&](std::size_t leaf) {
    if (drawn++ > 0 && !room.empty()) room.pop_back();
    return draw_leaf(chunks, leaves[leaf]);
  });
  const std::uint64_t own_around = counts_.around;
  add_up(ranks_.all, {&counts_.visible, &counts_.bad, &counts_.too_sharp, &counts_.around,
                      &counts_.blocks_left_out, &counts_.tile_entries});
  if (leaves.empty() || counts_.too_sharp > 0) return {compositor_.start(), {}, {}};
  std::vector<CloudAround> around;
  if (counts_.around > 0) around = find_around(counts_.chunks_around, own_around);
  SplatLight light = sums.join();
  if (is_first() && !around.empty())
    surroundings_.draw(around, {0, around.size(), 0}, light.planes);
  return light;
}

// Memory for the light that is held while leaves are drawn, before it is needed: taken between two
// leaves, it would cost the pool free memory that the next one uses again.
std::vector<SplatLight> Pipeline::room_beside(std::size_t leaves) const {
  std::vector<SplatLight> room;
  for (std::size_t held = 1; held < most_held_leaves(leaves); ++held)
    room.push_back({compositor_.room(), certifier_.room(), {}});
  return room;
}

SplatLight Pipeline::draw_leaf(const std::vector<ParticleChunk>& chunks, const ChunkRange& leaf) {
  SplatLight light;
  light.planes = compositor_.start();
  for (std::size_t i = leaf.first; i < leaf.end && counts_.too_sharp == 0; ++i) {
    tell(i, chunks.size());
    add_chunk(chunks[i], light);
  }
  return light;
}

void Pipeline::add_chunk(const ParticleChunk& chunk, SplatLight& light) {
  ranks_.work.particles += chunk.count();
  SplatBlocks blocks = project(chunk);
  counts_.blocks_left_out += blocks.left_out;
  const CountedSplats counted = binner_.count(blocks);
  draw_lists(counted, counted.bands, light);
  // Read last: the device has long counted them.
  const ParticleCounts particles = projector_.count(blocks, chunk);
  ranks_.work.splats += particles.visible;
  // While the device draws the chunk.
  if (particles.around > 0 && counts_.around == 0) surroundings_.get_programs();
  counts_ += particles;
}

struct Pipeline::Order {
  SplatSlices slices;
  Relay relay;
  std::uint64_t splats = 0;        // with the clouds that lists have
  std::vector<SplatChunk> chunks;  // of all splats
  std::vector<CloudRange> clouds;  // around the camera, of each slice
  bool in_bands = false;           // as ranks pass it on
};

// Splats are sorted slice by slice, nearest first, and composited chunk by chunk, each slice behind
// what comes from the one before. One process that has room for all splats has one slice.
SplatLight Pipeline::draw_ordered() {
  SplatLight light;
  light.planes = compositor_.start();
  Order order = {{context_, projector_, particles_, ranks_},
                 {context_, projector_, transfer_, ranks_},
                 0,
                 {},
                 {}};
  SplatSlices& slices = order.slices;
  slices.find();
  take_counts(slices);
  if (counts_.too_sharp > 0) return light;
  if (counts_.around > 0) take_around(find_around(counts_.chunks_around, slices.own_around()));
  order.splats = slices.particles().visible + in_lists_.count();
  order.clouds = slice_around(slices.slices());
  order.chunks = splat_chunks(order.splats, context_.plan.slabs, context_.device.traits);
  if (context_.plan.slabs > 0) light.slab = resolver_.start_slabs();
  // Slabs and layers of clouds are laid over the whole picture.
  order.in_bands = ranks_.size() > 1 && context_.plan.slabs == 0 && around_.clouds().empty() &&
                   slices.has_room_for_copies();
  for (std::size_t round = 0; round < slices.rounds(); ++round)
    draw_slice(round, order, light);
  light = order.relay.bring_home(std::move(light));
  add_up(ranks_.all, {&counts_.tile_entries});
  return light;
}

void Pipeline::draw_slice(std::size_t round, Order& order, SplatLight& light) {
  Relay& relay = order.relay;
  const std::size_t number = order.slices.number_of_slice(round);
  const CloudRange in_lists = in_lists_.count() > 0 ? order.clouds[number] : CloudRange();
  const SlicePart part =
      part_of(with_clouds(order.slices.slices()[number], in_lists), order.chunks);
  KeyedSplats keyed = order.slices.take(round, part.carried, in_lists.count());
  place_around(keyed, part.first, order.clouds[number]);
  if (round > 0) relay.pass_round(light);
  const SortedSplats sorted = sorter_.sort(std::move(keyed));
  relay.take_splats(round, sorted.splats, part.carried);
  // Of a later round the first rank takes all that the last one has before it sends anything.
  if (relay.is_first_rank() && relay.has_other_before(round))
    light = relay.receive_light(std::move(light.slab));
  relay.pass_splats(sorted, part.passed_on);
  ranks_.work.splats += part.composited();
  if (order.in_bands) return draw_bands(sorted, part, order, light);
  if (!relay.is_first_rank()) light = relay.receive_light(std::move(light.slab));
  draw_chunks(sorted, part, order, light);
  // Clouds around the camera that lie behind all splats.
  if (number + 1 == order.clouds.size()) {
    while (const std::optional<CloudLayer> layer = around_.take_before(end_of_keys))
      draw_around(*layer, light);
  }
  relay.send_on(light);
}

// Clouds around the camera lie between splats. Slabs end there.
void Pipeline::draw_chunks(const SortedSplats& sorted, const SlicePart& part, const Order& order,
                           SplatLight& light) {
  for (std::size_t c = part.first_chunk; c < part.end_chunk; ++c) {
    tell(c, order.chunks.size());
    SplatChunk chunk = order.chunks[c];
    while (const std::optional<CloudLayer> layer = around_.take_before(chunk.first + chunk.count)) {
      const auto before = static_cast<std::uint32_t>(layer->splats_before - chunk.first);
      draw_splats(sorted, {chunk.first - part.first, before, true}, light);
      draw_around(*layer, light);
      chunk.first += before;
      chunk.count -= before;
    }
    chunk.first -= part.first;
    draw_splats(sorted, chunk, light);
  }
}

// Band by band of the picture, each as soon as the rank before has passed it on.
void Pipeline::draw_bands(const SortedSplats& sorted, const SlicePart& part, const Order& order,
                          SplatLight& light) {
  std::vector<CountedSplats> counted;
  for (std::size_t c = part.first_chunk; c < part.end_chunk; ++c) {
    SplatChunk chunk = order.chunks[c];
    chunk.first -= part.first;
    counted.push_back(binner_.count(sorted, chunk));
  }
  certifier_.begin(light.cells);
  const LightTransfer::Rows rows = {light.planes, light.cells, certifier_.cells_per_tile()};
  for (const TileBand& band : relay_bands(context_.layout, ranks_.size())) {
    if (!order.relay.is_first_rank()) transfer_.receive(rows, band, ranks_.rank() - 1);
    for (const CountedSplats& chunk : counted)
      draw_lists(chunk, parts_in(band, chunk.bands), light);
    if (!order.relay.is_last_rank()) transfer_.send(rows, band, ranks_.rank() + 1);
  }
}

void Pipeline::draw_splats(const SortedSplats& sorted, const SplatChunk& chunk, SplatLight& light) {
  if (chunk.count > 0) {
    const CountedSplats counted = binner_.count(sorted, chunk);
    draw_lists(counted, counted.bands, light);
  }
  if (context_.plan.slabs > 0 && chunk.ends_slab)
    light.planes = resolver_.lay_slab(std::move(light.planes), light.slab);
}

// Tiles do not depend on each other, so lists that do not fit together are made and drawn
// band by band of the picture, to the same bits.
void Pipeline::draw_lists(const CountedSplats& counted, const std::vector<TileBand>& bands,
                          SplatLight& light) {
  for (const TileBand& band : bands) {
    const TileLists lists = binner_.make_lists(counted, band);
    counts_.tile_entries += lists.entry_count;
    certifier_.collect(lists, light.cells);
    light.planes = compositor_.composite(lists, *counted.splats, std::move(light.planes));
  }
}

std::vector<CloudAround> Pipeline::find_around(const std::vector<ChunkBlocks>& own_blocks,
                                               std::uint64_t own) {
  const auto get = [this](const ParticleChunk& chunk) {
    return particles_in_view(context_, particles_, chunk);
  };
  std::vector<CloudAround> clouds =
      surroundings_.in_order(gather_clouds(ranks_.all, surroundings_.list(own_blocks, get, own)));
  counts_.visible += clouds.size();
  return clouds;
}

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

std::vector<CloudRange> Pipeline::slice_around(const std::vector<KeySlice>& slices) const {
  std::vector<std::uint64_t> keys = in_lists_.keys();
  for (const CloudAround& cloud : around_.clouds())
    keys.push_back(cloud.key);
  return clouds_of_slices(keys, slices);
}

// Of layers all ranks have to know all places of the round: clouds at the end of one slice may be
// of one layer with those that begin the next.
void Pipeline::place_around(KeyedSplats& keyed, std::uint64_t first, const CloudRange& clouds) {
  if (in_lists_.count() > 0) in_lists_.append(clouds.first, clouds.end, keyed);
  if (around_.clouds().empty()) return;
  std::vector<std::uint64_t> keys;
  if (clouds.first < clouds.end)
    keys = sort_keys_up_to(context_, keyed, around_.clouds()[clouds.end - 1].key);
  around_.append_places(
      gather_lists(ranks_.all, around_.places_among(keys, first, clouds.first, clouds.end)));
  around_.skip_before(first);
}

void Pipeline::draw_around(const CloudLayer& layer, const SplatLight& light) {
  surroundings_.draw(around_.clouds(), layer, light.planes);
  if (context_.plan.slabs > 0) resolver_.begin_slab(light.planes, light.slab);
}

void Pipeline::take_counts(const SplatSlices& slices) {
  static_cast<ParticleCounts&>(counts_) = slices.particles();
  counts_.blocks_left_out = slices.left_out();
  const bool alone_in_windows = ranks_.size() == 1 && !slices.is_whole();
  if (slices.rounds() > 1 || alone_in_windows) counts_.windows = slices.slices().size();
}

// The device has drawn all parts but the last: counting the splats of a part waits for those
// before.
void Pipeline::tell(std::size_t done, std::size_t total) const {
  if (progress_ && total > 1) progress_(static_cast<double>(done) / static_cast<double>(total));
}

}  // namespace splotchcl
