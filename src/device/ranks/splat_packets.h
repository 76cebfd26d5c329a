#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "device/frame/records.h"
#include "device/frame/stage_context.h"
#include "splotchcl/communicator.h"
#include "surroundings/cloud_around.h"

namespace splotchcl {

// Splats with their keys in the host's memory, as ranks send them to each other.
struct HostSplats {
  std::vector<std::uint32_t> keys;
  std::vector<std::uint16_t> key_ends;  // none where a field is the key
  std::vector<std::byte> splats, extended;

  std::size_t size() const { return keys.size(); }
  std::uint64_t key(std::size_t i) const {
    return std::uint64_t{keys[i]} << 16 | (key_ends.empty() ? 0u : key_ends[i]);
  }
};

// The first `count` of these.
HostSplats download_splats(const StageContext& context, const KeyedSplats& keyed,
                           std::uint32_t count);

// Splat i goes to packet places[i], or to none where there is no such; in their order.
std::vector<Communicator::Bytes> pack(const StageContext& context, const HostSplats& splats,
                                      const std::vector<std::uint32_t>& places,
                                      std::size_t packets);

// What is in a packet, in this order: how many splats, keys, ends, splats, extended ones.
std::uint64_t splats_in(const Communicator::Bytes& packet);
// Writes them and their keys from slot `slot` on.
void unpack(const StageContext& context, const Communicator::Bytes& packet,
            const KeyedSplats& keyed, std::uint64_t slot);

// Collective: the clouds of all ranks, those of the first one first; known to all.
std::vector<CloudAround> gather_clouds(Communicator& ranks, const std::vector<CloudAround>& own);

}  // namespace splotchcl
