#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "device/frame/records.h"
#include "device/frame/stage_context.h"
#include "splotchcl/communicator.h"
#include "surroundings/cloud_around.h"

namespace splotchcl {

// Where a splat of this sort key goes.
using PacketOfKey = std::function<std::size_t(std::uint64_t key)>;

// The first `count` of these splats with their keys, as ranks send them to each other: each in the
// packet of its key, or in none where there is no such; in their order.
std::vector<Communicator::Bytes> pack(const StageContext& context, const KeyedSplats& keyed,
                                      std::uint32_t count, std::size_t packets,
                                      const PacketOfKey& packet_of);

std::uint64_t splats_in(const Communicator::Bytes& packet);
// Writes them and their keys from slot `slot` on.
void unpack(const StageContext& context, const Communicator::Bytes& packet,
            const KeyedSplats& keyed, std::uint64_t slot);

// Collective: the clouds of all ranks, those of the first one first; known to all.
std::vector<CloudAround> gather_clouds(Communicator& ranks, const std::vector<CloudAround>& own);

}  // namespace splotchcl
