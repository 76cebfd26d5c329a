// The stages of one frame that several ranks draw together: to the bits of one process.
#include <utility>

#include "device/pipeline.h"
#include "device/ranks/cloud_packets.h"
#include "device/ranks/relay_bands.h"
#include "device/ranks/slice_clouds.h"
#include "device/ranks/slice_part.h"
#include "device/ranks/splat_exchange.h"
#include "device/stages/carry_splats.h"
#include "ranks/exchange.h"

namespace splotchcl {
namespace {

// The last `count` of the sorted splats in their order, from one rank to the next.
class PassedSplats {
 public:
  PassedSplats() = default;
  PassedSplats(const StageContext& context, const Projector& projector, const SortedSplats& sorted,
               std::uint32_t count) {
    if (count == 0) return;
    const KeyedSplats last = projector.keyed_memory(count);
    carry_splats(context, sorted, sorted.count - count, last);
    const Variant& variant = context.variant;
    BufferPool& pool = context.device.pool;
    splats_ = pool.download(last.splats.splats, count * variant.splat_bytes());
    extended_ = pool.download(last.splats.extended, count * variant.extended_splat_bytes());
  }

  void send(FrameRanks& ranks, int to) const {
    for (const std::vector<std::byte>* bytes : {&splats_, &extended_}) {
      if (!bytes->empty()) ranks.all.send(bytes->data(), bytes->size(), to);
      ranks.work.sent_bytes += bytes->size();
    }
  }

  // Into the first `count` slots.
  static void receive(const StageContext& context, FrameRanks& ranks, int from,
                      const SplatMemory& splats, std::uint32_t count) {
    if (count == 0) return;
    const Variant& variant = context.variant;
    const auto take = [&](const Buffer<std::byte>& to, std::size_t splat_bytes) {
      std::vector<std::byte> bytes(count * splat_bytes);
      if (bytes.empty()) return;
      ranks.all.receive(bytes.data(), bytes.size(), from);
      context.device.pool.write(to, 0, bytes.data(), bytes.size());
    };
    take(splats.splats, variant.splat_bytes());
    take(splats.extended, variant.extended_splat_bytes());
  }

 private:
  std::vector<std::byte> splats_, extended_;
};

}  // namespace

void Pipeline::add_up_counts() {
  if (ranks_ == nullptr) return;
  add_up(ranks_->all, {&counts_.visible, &counts_.bad, &counts_.too_sharp, &counts_.around,
                       &counts_.blocks_left_out, &counts_.tile_entries});
}

std::vector<CloudAround> Pipeline::gather_around(const std::vector<ChunkBlocks>& own_chunks,
                                                 std::uint64_t own) {
  std::vector<CloudAround> clouds =
      surroundings_.in_order(gather_clouds(ranks_->all, list_around(own_chunks, own)));
  counts_.visible += clouds.size();
  return clouds;
}

// What compositing goes on with: planes, what the check needs, and the slab that has begun.
void Pipeline::send_state(const SplatLight& light, int to) {
  transfer_->send(light, to);
  if (context_.plan.slabs > 0) transfer_->send(slab_light_, to);
}

SplatLight Pipeline::receive_state(int from) {
  SplatLight light = transfer_->receive(from);
  if (context_.plan.slabs > 0) transfer_->receive(slab_light_, from);
  return light;
}

// Which clouds around the camera lie in which slices.
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
      gather_lists(ranks_->all, around_.places_among(keys, first, clouds.first, clouds.end)));
  around_.skip_before(first);
}

// Each rank sorts a slice of the order, nearest first by ranks, and composites its chunks behind
// what comes from the rank before. In rounds the last rank passes on to the first of the next
// round; it waits with that until all splats of that round are where they belong, for which all
// ranks are needed.
Planes Pipeline::draw_slices(Planes planes) {
  SplatExchange exchange(context_, projector_, particles_, *ranks_);
  exchange.count_keys();
  take_counts(exchange.particles(), exchange.left_out());
  if (counts_.too_sharp > 0) return planes;
  if (counts_.around > 0) {
    const DeviceTraits& traits = context_.device.traits;
    take_around(gather_around(all_blocks(exchange.chunks(), traits), exchange.own_around()));
  }
  const std::uint64_t splats = exchange.particles().visible + in_lists_.count();
  const std::vector<CloudRange> clouds_of = slice_around(exchange.slices());
  const int rank = ranks_->rank(), last = ranks_->size() - 1;
  counts_.windows =
      exchange.rounds() > 1 ? exchange.rounds() * static_cast<std::uint64_t>(last + 1) : 0;
  const std::vector<SplatChunk> chunks =
      splat_chunks(splats, context_.plan.slabs, context_.device.traits);
  if (context_.plan.slabs > 0) slab_light_ = resolver_.start_slabs();

  // Slabs and layers of clouds are laid over the whole picture.
  const bool in_bands =
      context_.plan.slabs == 0 && around_.clouds().empty() && exchange.has_room_for_copies();

  SplatLight light;
  light.planes = std::move(planes);
  PassedSplats passed;
  for (std::size_t round = 0; round < exchange.rounds(); ++round) {
    const std::size_t number = exchange.number_of_slice(round, rank);
    const CloudRange in_lists = in_lists_.count() > 0 ? clouds_of[number] : CloudRange();
    const SlicePart part = part_of(with_clouds(exchange.slices()[number], in_lists), chunks);
    KeyedSplats keyed = exchange.take(round, part.carried, in_lists.count());
    place_around(keyed, part.first, clouds_of[number]);
    if (round > 0 && rank == last) {
      passed.send(*ranks_, 0);
      send_state(light, 0);
    }
    const SortedSplats sorted = sorter_.sort(std::move(keyed));
    const bool goes_on = rank > 0 || round > 0;
    const int before = rank > 0 ? rank - 1 : last;
    if (goes_on) PassedSplats::receive(context_, *ranks_, before, sorted.splats, part.carried);
    // Of a later round the first rank takes all that the last one has before it sends anything.
    if (rank == 0 && round > 0) light = receive_state(before);
    passed = PassedSplats(context_, projector_, sorted, part.passed_on);
    if (rank < last) passed.send(*ranks_, rank + 1);
    if (in_bands) {
      light = draw_slice_in_bands(sorted, part, chunks, std::move(light));
      continue;
    }
    if (rank > 0) light = receive_state(before);
    light = draw_slice(sorted, part, chunks, std::move(light));
    if (number + 1 == clouds_of.size()) light.planes = end_order(splats, std::move(light.planes));
    if (rank < last) send_state(light, rank + 1);
  }
  if (rank == last && last > 0) send_state(light, 0);
  if (rank == 0 && last > 0) light = receive_state(last);
  std::vector<std::uint64_t> entries = {counts_.tile_entries};
  ranks_->all.add_up(entries);
  counts_.tile_entries = entries.front();
  certifier_.put_cells(std::move(light.cells));
  return std::move(light.planes);
}

// Band by band of the picture, each as soon as the rank before has passed it on.
SplatLight Pipeline::draw_slice_in_bands(const SortedSplats& sorted, const SlicePart& part,
                                         const std::vector<SplatChunk>& chunks, SplatLight light) {
  ranks_->work.splats += part.composited();
  std::vector<CountedSplats> counted;
  for (std::size_t c = part.first_chunk; c < part.end_chunk; ++c) {
    SplatChunk chunk = chunks[c];
    chunk.first -= part.first;
    counted.push_back(binner_.count(sorted, chunk));
  }
  const Buffer<float>& cells = certifier_.begin_cells();
  const int rank = ranks_->rank(), last = ranks_->size() - 1;
  const LightTransfer::Rows rows = {light.planes, cells, certifier_.cells_per_tile()};
  for (const TileBand& band : relay_bands(context_.layout, ranks_->size())) {
    if (rank > 0) transfer_->receive(rows, band, rank - 1);
    for (const CountedSplats& chunk : counted)
      light.planes = draw_lists(chunk, parts_in(band, chunk.bands), std::move(light.planes));
    if (rank < last) transfer_->send(rows, band, rank + 1);
  }
  light.cells = certifier_.take_cells();
  return light;
}

SplatLight Pipeline::draw_slice(const SortedSplats& sorted, const SlicePart& part,
                                const std::vector<SplatChunk>& chunks, SplatLight light) {
  certifier_.put_cells(std::move(light.cells));
  ranks_->work.splats += part.composited();
  std::size_t next = part.first_chunk;
  light.planes = draw_chunks(sorted, part.first, chunks, next, std::move(light.planes));
  light.cells = certifier_.take_cells();
  return light;
}

}  // namespace splotchcl
