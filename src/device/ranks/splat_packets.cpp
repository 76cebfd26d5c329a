#include "device/ranks/splat_packets.h"

#include <cstring>
#include <numeric>
#include <type_traits>

namespace splotchcl {
namespace {

// Where the parts of a packet begin.
struct PacketLayout {
  PacketLayout(const StageContext& context, std::uint64_t count)
      : by_depth(context.frame.sort.by == SortOrder::By::depth),
        splat_bytes(context.variant.splat_bytes()),
        extended_bytes(context.variant.extended_splat_bytes()),
        ends(keys + count * sizeof(std::uint32_t)),
        // What follows is read as integers of 32 bits.
        splats(ends + (by_depth ? (count + count % 2) * sizeof(std::uint16_t) : 0)),
        extended(splats + count * splat_bytes),
        bytes(extended + count * extended_bytes) {}

  bool by_depth;
  std::size_t splat_bytes, extended_bytes;
  std::size_t keys = sizeof(std::uint64_t);
  std::size_t ends, splats, extended, bytes;
};

template <class T>
void copy(const std::vector<T>& from, std::size_t i, std::size_t values, std::byte* to) {
  std::memcpy(to, from.data() + i * values, values * sizeof(T));
}

}  // namespace

HostSplats download_splats(const StageContext& context, const KeyedSplats& keyed,
                           std::uint32_t count) {
  BufferPool& pool = context.device.pool;
  const PacketLayout layout(context, count);
  HostSplats host;
  host.keys = pool.download(keyed.keys, count);
  host.key_ends = pool.download(keyed.key_ends, layout.by_depth ? count : 0);
  host.splats = pool.download(keyed.splats.splats, count * layout.splat_bytes);
  host.extended = pool.download(keyed.splats.extended, count * layout.extended_bytes);
  return host;
}

std::vector<Communicator::Bytes> pack(const StageContext& context, const HostSplats& splats,
                                      const std::vector<std::uint32_t>& places,
                                      std::size_t packets) {
  std::vector<std::uint64_t> counts(packets);
  for (const std::uint32_t place : places) {
    if (place < packets) ++counts[place];
  }
  std::vector<PacketLayout> layouts;
  std::vector<Communicator::Bytes> packed;
  for (const std::uint64_t count : counts) {
    layouts.emplace_back(context, count);
    packed.emplace_back(layouts.back().bytes);
    std::memcpy(packed.back().data(), &count, sizeof(count));
  }
  std::vector<std::size_t> filled(packets);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i] >= packets) continue;
    const PacketLayout& layout = layouts[places[i]];
    std::byte* const packet = packed[places[i]].data();
    const std::size_t k = filled[places[i]]++;
    copy(splats.keys, i, 1, packet + layout.keys + k * sizeof(std::uint32_t));
    if (layout.by_depth)
      copy(splats.key_ends, i, 1, packet + layout.ends + k * sizeof(std::uint16_t));
    copy(splats.splats, i, layout.splat_bytes, packet + layout.splats + k * layout.splat_bytes);
    if (layout.extended_bytes > 0) {
      copy(splats.extended, i, layout.extended_bytes,
           packet + layout.extended + k * layout.extended_bytes);
    }
  }
  return packed;
}

std::uint64_t splats_in(const Communicator::Bytes& packet) {
  std::uint64_t count = 0;
  if (!packet.empty()) std::memcpy(&count, packet.data(), sizeof(count));
  return count;
}

void unpack(const StageContext& context, const Communicator::Bytes& packet,
            const KeyedSplats& keyed, std::uint64_t slot) {
  const std::uint64_t count = splats_in(packet);
  if (count == 0) return;
  BufferPool& pool = context.device.pool;
  const PacketLayout layout(context, count);
  const std::byte* const data = packet.data();
  const auto in_packet = static_cast<std::size_t>(count);
  pool.write(keyed.keys, slot, reinterpret_cast<const std::uint32_t*>(data + layout.keys),
             in_packet);
  if (layout.by_depth) {
    pool.write(keyed.key_ends, slot, reinterpret_cast<const std::uint16_t*>(data + layout.ends),
               in_packet);
  }
  pool.write(keyed.splats.splats, slot * layout.splat_bytes, data + layout.splats,
             in_packet * layout.splat_bytes);
  pool.write(keyed.splats.extended, slot * layout.extended_bytes, data + layout.extended,
             in_packet * layout.extended_bytes);
  std::vector<std::uint32_t> order(in_packet);
  std::iota(order.begin(), order.end(), static_cast<std::uint32_t>(slot));
  pool.write(keyed.order, slot, order.data(), in_packet);
}

namespace {

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
