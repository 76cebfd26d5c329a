#include "device/frame/block_counts.h"

namespace splotchcl {

ParticleCounts sum_of(const std::vector<shared::BlockCounts>& blocks) {
  ParticleCounts sum;
  for (const shared::BlockCounts& block : blocks) {
    sum.visible += block.visible;
    sum.bad += block.bad;
    sum.too_sharp += block.too_sharp;
    sum.around += block.around;
  }
  return sum;
}

std::vector<std::uint32_t> blocks_around(const shared::BlockCounts* first, std::size_t count) {
  std::vector<std::uint32_t> blocks;
  for (std::uint32_t b = 0; b < count; ++b) {
    if (first[b].around > 0) blocks.push_back(b);
  }
  return blocks;
}

std::vector<std::uint32_t> first_slots(std::uint32_t blocks, std::uint32_t stride) {
  std::vector<std::uint32_t> first(std::size_t{blocks} + 1);
  for (std::uint32_t b = 0; b <= blocks; ++b)
    first[b] = b * stride;
  return first;
}

std::vector<std::uint32_t> first_splats(const std::vector<shared::BlockCounts>& blocks) {
  std::vector<std::uint32_t> first = {0};
  for (const shared::BlockCounts& block : blocks)
    first.push_back(first.back() + block.visible);
  return first;
}

std::vector<std::uint32_t> free_slots(const std::vector<shared::BlockCounts>& blocks,
                                      std::uint32_t stride, std::uint64_t wanted) {
  std::vector<std::uint32_t> slots;
  for (std::uint32_t b = 0; b < blocks.size(); ++b) {
    for (std::uint32_t k = blocks[b].visible; k < stride && slots.size() < wanted; ++k)
      slots.push_back(b * stride + k);
  }
  return slots;
}

}  // namespace splotchcl
