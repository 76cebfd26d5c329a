#include "device/sorter.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace splotchcl {
namespace {

constexpr std::uint32_t digit_bits = 8;
constexpr std::uint32_t digits = 1u << digit_bits;

// The bits in which the keys differ, from those that are set in some and in all of a block's.
std::uint32_t differing_bits(const std::vector<std::array<std::uint32_t, 2>>& blocks) {
  std::uint32_t some = 0, all = ~0u;
  for (const auto& [in_some, in_all] : blocks) {
    some |= in_some;
    all &= in_all;
  }
  return some & ~all;
}

}  // namespace

Sorter::Pairs Sorter::sort(const Pairs& pairs, std::uint32_t count) {
  if (count < 2) return pairs;
  const std::uint32_t wanted = device_.traits.sort_blocks;
  const std::uint32_t block_length = std::max(1024u, count / wanted + (count % wanted != 0));
  const std::uint32_t block_count = count / block_length + (count % block_length != 0);
  const std::uint32_t histogram_size = digits * block_count;

  Buffers& buffers = device_.buffers;
  const compute::buffer histograms = buffers.get("sort histograms", 4ull * histogram_size);
  Pairs from = pairs;
  Pairs to = {buffers.get("keys (sorting)", 4ull * count),
              buffers.get("order (sorting)", 4ull * count)};
  const compute::buffer bits = buffers.get("sort bits", 8ull * block_count);
  const compute::program program = device_.programs.get("", {"sort.cl"});
  std::uint32_t differing = ~0u;  // until the first pass has seen the keys
  for (std::uint32_t shift = 0; shift < 32; shift += digit_bits) {
    if (shift > 0 && (differing >> shift) % digits == 0) continue;
    Launch(device_, "sort", program.create_kernel("sort_histogram"))
        .arg(from.keys)
        .value(count)
        .value(block_length)
        .value(shift)
        .value(block_count)
        .arg(histograms)
        .arg(bits)
        .run_items(block_count);
    if (shift == 0) {
      std::vector<std::array<std::uint32_t, 2>> seen(block_count);
      device_.queue.enqueue_read_buffer(bits, 0, 8ull * block_count, seen.data());
      differing = differing_bits(seen);
      if (differing % digits == 0) continue;
    }
    Launch(device_, "sort", program.create_kernel("sort_scan"))
        .value(histogram_size)
        .arg(histograms)
        .run_items(1);
    Launch(device_, "sort", program.create_kernel("sort_scatter"))
        .arg(from.keys)
        .arg(from.values)
        .value(count)
        .value(block_length)
        .value(shift)
        .value(block_count)
        .arg(histograms)
        .arg(to.keys)
        .arg(to.values)
        .run_items(block_count);
    std::swap(from, to);
  }
  return from;
}

void Sorter::release_buffers() {
  device_.queue.finish();
  for (const char* name :
       {"keys", "order", "keys (sorting)", "order (sorting)", "sort histograms", "sort bits"}) {
    device_.buffers.release(name);
  }
}

}  // namespace splotchcl
