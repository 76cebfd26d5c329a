#include "device/ranks/transfers.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <type_traits>
#include <utility>
#include <vector>

namespace splotchcl {
namespace {

// What is in a packet, in this order: how many splats, keys, ends, splats. Calls take(buffer,
// values) with each of the device's buffers that has some, and how many of a splat.
template <class Take>
void each_column(const StageContext& context, const KeyedSplats& keyed, const Take& take) {
  take(keyed.keys, std::size_t{1});
  if (keyed.key_ends.size() > 0) take(keyed.key_ends, std::size_t{1});
  take(keyed.splats, context.variant.splat_bytes());
}

template <class T>
const T* as_values_of(const Buffer<T>&, const std::byte* bytes) {
  return reinterpret_cast<const T*>(bytes);
}

// The 48 bits of the first `count`.
std::vector<std::uint64_t> download_keys(BufferPool& pool, const KeyedSplats& keyed,
                                         std::uint32_t count) {
  const std::vector<std::uint32_t> upper = pool.download(keyed.keys, count);
  std::vector<std::uint64_t> keys(upper.begin(), upper.end());
  for (std::uint64_t& key : keys)
    key <<= 16;
  const std::vector<std::uint16_t> ends =
      pool.download(keyed.key_ends, keyed.key_ends.size() > 0 ? count : 0);
  for (std::size_t i = 0; i < ends.size(); ++i)
    keys[i] |= ends[i];
  return keys;
}

// What each cloud has, before its splats.
struct FixedPart {
  std::uint64_t key = 0, splats = 0;
  Vec3 center{};
  double ray = 0, splat = 0;
  std::array<double, 3> emission{}, absorption{};
  double farthest2 = 0;
};
static_assert(std::is_trivially_copyable_v<FixedPart> && std::is_trivially_copyable_v<SplatAround>);

template <class T>
void append(const T& value, Communicator::Bytes& bytes) {
  const std::size_t first = bytes.size();
  bytes.resize(first + sizeof(T));
  std::memcpy(bytes.data() + first, &value, sizeof(T));
}

template <class T>
T take(const Communicator::Bytes& bytes, std::size_t& next) {
  T value;
  std::memcpy(&value, bytes.data() + next, sizeof(T));
  next += sizeof(T);
  return value;
}

struct LightHeader {
  std::uint32_t used_grids = 0;
  std::uint32_t cells = 0;
};

// The host holds so many floats at a time.
constexpr std::uint64_t most_at_once = 16u << 20;

template <class Pass>
void in_stretches(std::uint64_t first, std::uint64_t count, const Pass& pass) {
  std::vector<float> floats;
  for (std::uint64_t done = 0; done < count; done += floats.size()) {
    floats.resize(static_cast<std::size_t>(std::min(most_at_once, count - done)));
    pass(floats, first + done);
  }
}

}  // namespace

std::vector<Communicator::Bytes> pack(const StageContext& context, const KeyedSplats& keyed,
                                      std::uint32_t count, std::size_t packets,
                                      const PacketOfKey& packet_of) {
  BufferPool& pool = context.device.pool;
  std::vector<std::size_t> places;
  std::vector<std::uint64_t> counts(packets);
  for (const std::uint64_t key : download_keys(pool, keyed, count)) {
    places.push_back(packet_of(key));
    if (places.back() < packets) ++counts[places.back()];
  }
  std::vector<Communicator::Bytes> packed(packets);
  for (std::size_t packet = 0; packet < packets; ++packet)
    append(counts[packet], packed[packet]);
  each_column(context, keyed, [&](const auto& buffer, std::size_t values) {
    const auto column = pool.download(buffer, count * values);
    const std::size_t bytes = values * sizeof(column.front());
    std::vector<std::size_t> next(packets);
    for (std::size_t packet = 0; packet < packets; ++packet) {
      next[packet] = packed[packet].size();
      packed[packet].resize(next[packet] + counts[packet] * bytes);
    }
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (places[i] >= packets) continue;
      std::memcpy(packed[places[i]].data() + next[places[i]], column.data() + i * values, bytes);
      next[places[i]] += bytes;
    }
  });
  return packed;
}

std::uint64_t splats_in(const Communicator::Bytes& packet) {
  std::uint64_t count = 0;
  if (!packet.empty()) std::memcpy(&count, packet.data(), sizeof(count));
  return count;
}

void unpack(const StageContext& context, const Communicator::Bytes& packet,
            const KeyedSplats& keyed, std::uint64_t slot) {
  const auto count = static_cast<std::size_t>(splats_in(packet));
  if (count == 0) return;
  BufferPool& pool = context.device.pool;
  const std::byte* next = packet.data() + sizeof(std::uint64_t);
  each_column(context, keyed, [&](const auto& buffer, std::size_t values) {
    const auto* const column = as_values_of(buffer, next);
    pool.write(buffer, slot * values, column, count * values);
    next += count * values * sizeof(*column);
  });
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), static_cast<std::uint32_t>(slot));
  pool.write(keyed.order, slot, order.data(), count);
}

std::vector<CloudAround> gather_clouds(Communicator& ranks, const std::vector<CloudAround>& own) {
  Communicator::Bytes bytes;
  for (const CloudAround& cloud : own) {
    append(FixedPart{cloud.key, cloud.splats.size(), cloud.center, cloud.ray, cloud.splat,
                     cloud.emission, cloud.absorption, cloud.farthest2},
           bytes);
    for (const SplatAround& splat : cloud.splats)
      append(splat, bytes);
  }
  std::vector<CloudAround> clouds;
  for (const Communicator::Bytes& of_rank : ranks.gather(bytes)) {
    for (std::size_t next = 0; next < of_rank.size();) {
      const auto fixed = take<FixedPart>(of_rank, next);
      CloudAround& cloud = clouds.emplace_back();
      cloud.key = fixed.key;
      cloud.center = fixed.center;
      cloud.ray = fixed.ray;
      cloud.splat = fixed.splat;
      cloud.emission = fixed.emission;
      cloud.absorption = fixed.absorption;
      cloud.farthest2 = fixed.farthest2;
      for (std::uint64_t i = 0; i < fixed.splats; ++i)
        cloud.splats.push_back(take<SplatAround>(of_rank, next));
    }
  }
  return clouds;
}

LightTransfer::PassFloats LightTransfer::sending(int to) const {
  return [this, to](const Buffer<float>& buffer, std::uint64_t first, std::uint64_t count) {
    in_stretches(first, count, [&](std::vector<float>& floats, std::uint64_t begin) {
      context_.device.pool.read(buffer, begin, floats.data(), floats.size());
      ranks_.all.send(floats.data(), floats.size() * sizeof(float), to);
    });
    ranks_.work.sent_bytes += count * sizeof(float);
  };
}

LightTransfer::PassFloats LightTransfer::receiving(int from) const {
  return [this, from](const Buffer<float>& buffer, std::uint64_t first, std::uint64_t count) {
    in_stretches(first, count, [&](std::vector<float>& floats, std::uint64_t begin) {
      ranks_.all.receive(floats.data(), floats.size() * sizeof(float), from);
      context_.device.pool.write(buffer, begin, floats.data(), floats.size());
    });
  };
}

void LightTransfer::each_part(const SplatLight& light, const PassFloats& pass) const {
  for (std::size_t g = 0; g < context_.layout.grids.size(); ++g) {
    if ((light.planes.used_grids >> g & 1) == 0) continue;
    const shared::Grid& grid = context_.layout.grids[g];
    pass(light.planes.light, floats_before(grid),
         std::uint64_t{context_.variant.planes()} * grid.plane_size);
  }
  for (const Buffer<float>* floats : {&light.cells, &light.slab.before, &light.slab.errors})
    pass(*floats, 0, floats->size());
}

void LightTransfer::each_part(const Rows& rows, const TileBand& tiles,
                              const PassFloats& pass) const {
  const shared::Grid& grid = context_.layout.grids.front();
  const auto across = static_cast<std::uint32_t>(grid.tiles_x);
  const std::uint64_t row = std::uint64_t{grid.stride} * context_.variant.tile_height;
  for (std::uint32_t plane = 0; plane < context_.variant.planes(); ++plane) {
    pass(rows.planes.light,
         floats_before(grid) + std::uint64_t{plane} * grid.plane_size + tiles.first / across * row,
         (tiles.end - tiles.first) / across * row);
  }
  pass(rows.cells, std::uint64_t{tiles.first} * rows.cells_per_tile,
       std::uint64_t{tiles.end - tiles.first} * rows.cells_per_tile);
}

void LightTransfer::send(const SplatLight& light, int to) const {
  const LightHeader header = {light.planes.used_grids,
                              static_cast<std::uint32_t>(light.cells.size())};
  ranks_.all.send(&header, sizeof(header), to);
  each_part(light, sending(to));
}

SplatLight LightTransfer::receive(int from, SlabLight slab) const {
  LightHeader header;
  ranks_.all.receive(&header, sizeof(header), from);
  SplatLight light;
  light.planes = compositor_.start();
  light.planes.used_grids = header.used_grids;
  if (header.cells > 0) light.cells = context_.device.pool.get<float>(header.cells, "peak cells");
  light.slab = std::move(slab);
  each_part(light, receiving(from));
  return light;
}

void LightTransfer::send(const Rows& rows, const TileBand& tiles, int to) const {
  each_part(rows, tiles, sending(to));
}

void LightTransfer::receive(const Rows& rows, const TileBand& tiles, int from) const {
  each_part(rows, tiles, receiving(from));
}

}  // namespace splotchcl
