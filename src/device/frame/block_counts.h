#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "device/frame/records.h"
#include "device/frame/shared.h"

// What follows from the counts of blocks that were projected.
namespace splotchcl {

ParticleCounts sum_of(const std::vector<shared::BlockCounts>& blocks);

// Which of a chunk's blocks have particles around the camera.
std::vector<std::uint32_t> blocks_around(const shared::BlockCounts* first, std::size_t count);

// Of blocks whose particles have a slot each, and of what follows the last.
std::vector<std::uint32_t> first_slots(std::uint32_t blocks, std::uint32_t stride);

// Of the same without gaps between the splats, and how many these are.
std::vector<std::uint32_t> first_splats(const std::vector<shared::BlockCounts>& blocks);

// The first `wanted` slots that their blocks' splats leave. Particles around the camera leave as
// many as they are.
std::vector<std::uint32_t> free_slots(const std::vector<shared::BlockCounts>& blocks,
                                      std::uint32_t stride, std::uint64_t wanted);

}  // namespace splotchcl
