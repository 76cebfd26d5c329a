#include "device/ranks/splat_packets.h"

#include <cstring>
#include <numeric>
#include <type_traits>

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

}  // namespace splotchcl
