#include "device/stages/sorter.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "device/frame/variant.h"
#include "device/opencl/launch.h"
#include "scene/ceil_divide.h"

namespace splotchcl {
namespace {

// The bits in which the keys differ, from those that are set in some and in all of a block's.
std::uint32_t differing_bits(const std::vector<shared::KeyBits>& blocks) {
  std::uint32_t some = 0, all = ~0u;
  for (const shared::KeyBits& block : blocks) {
    some |= block.some;
    all &= block.all;
  }
  return some & ~all;
}

shared::SortParameters make_parameters(std::uint32_t count, std::uint32_t wanted_blocks) {
  shared::SortParameters parameters{};
  parameters.count = count;
  parameters.block_length = std::max(1024u, ceil_divide(count, wanted_blocks));
  parameters.block_count = ceil_divide(count, parameters.block_length);
  return parameters;
}

}  // namespace

Sorter::Sorter(DeviceContext& device, bool is_used) : device_(device) {
  if (!is_used) return;
  if (device.traits.sorts_in_groups)
    groups_.emplace(device);
  else  // asked for, with those of other stages
    device.programs.get(program_source("kernels/sort/sort.cl"));
}

Sorter::Pairs Sorter::sort_pairs(Pairs pairs, std::uint32_t count) const {
  BufferPool& pool = device_.pool;
  shared::SortParameters parameters = make_parameters(count, device_.traits.sort_blocks);
  const auto histograms = pool.get<std::uint32_t>(
      std::uint64_t{SORT_DIGITS} * parameters.block_count, "sort histogram");
  const auto bits = pool.get<shared::KeyBits>(parameters.block_count, "key bits");
  const bool has_scratch = pairs.scratch.size() > 0;
  if (!has_scratch) pairs.scratch = pool.get<std::uint32_t>(count, "order");
  auto other_keys = pool.get<std::uint32_t>(count, "sort keys");
  const Program program = device_.programs.get(program_source("kernels/sort/sort.cl"));
  std::uint32_t differing = ~0u;  // until the first pass has seen the keys
  bool is_in_scratch = false;
  for (std::uint32_t shift = 0; shift < 32; shift += SORT_DIGIT_BITS) {
    // A digit that all keys share needs no pass.
    if (shift > 0 && (differing >> shift) % SORT_DIGITS == 0) continue;
    parameters.shift = shift;
    Launch(device_, "sort", program.create_kernel("sort_histogram"))
        .value(parameters)
        .arg(pairs.keys)
        .arg(histograms)
        .arg(bits)
        .run_pieces(parameters.block_count);
    if (shift == 0) {
      differing = differing_bits(pool.download(bits, parameters.block_count));
      if (differing % SORT_DIGITS == 0) continue;
    }
    Launch(device_, "sort", program.create_kernel("sort_scan"))
        .value(parameters)
        .arg(histograms)
        .run_items(1);
    Launch(device_, "sort", program.create_kernel("sort_scatter"))
        .value(parameters)
        .arg(pairs.keys)
        .arg(pairs.values)
        .arg(histograms)
        .arg(other_keys)
        .arg(pairs.scratch)
        .run_pieces(parameters.block_count);
    std::swap(pairs.keys, other_keys);
    std::swap(pairs.values, pairs.scratch);
    is_in_scratch = !is_in_scratch;
  }
  // Scratch memory is to go back soon.
  if (has_scratch && is_in_scratch) {
    device_.timer.add(
        "sort",
        device_.queue.enqueue_copy_buffer(pairs.values.memory(), pairs.scratch.memory(), 0, 0,
                                          std::size_t{count} * sizeof(std::uint32_t)),
        StageTimer::Kind::serial);
    std::swap(pairs.values, pairs.scratch);
  }
  return pairs;
}

// Upper bits that all keys share make room for ends. How many bits of the ends are left.
std::uint32_t Sorter::take_in_ends(const Buffer<std::uint32_t>& keys,
                                   const Buffer<std::uint16_t>& ends,
                                   const Buffer<std::uint32_t>& values, std::uint32_t count) const {
  shared::SortParameters parameters = make_parameters(count, device_.traits.sort_blocks);
  const auto bits = device_.pool.get<shared::KeyBits>(parameters.block_count, "key bits");
  const Program program = device_.programs.get(program_source("kernels/sort/sort.cl"));
  Launch(device_, "sort", program.create_kernel("sort_bits"))
      .value(parameters)
      .arg(keys)
      .arg(bits)
      .run_pieces(parameters.block_count);
  const std::uint32_t differing =
      differing_bits(device_.pool.download(bits, parameters.block_count));
  parameters.shift = 16;
  while (parameters.shift > 0 && differing >> (16 + parameters.shift - 1) == 0)
    --parameters.shift;
  if (parameters.shift == 16) return 16;
  Launch(device_, "sort", program.create_kernel("sort_take_in_ends"))
      .value(parameters)
      .arg(ends)
      .arg(values)
      .arg(keys)
      .run_pieces(parameters.block_count);
  return parameters.shift;
}

// Hardly any keys agree in their upper 32 bits, and those that do lie side by side once these
// are sorted: so their ends are neither moved nor digits of the radix sort.
Buffer<std::uint32_t> Sorter::sort_with_ends(Pairs pairs, const Buffer<std::uint16_t>& ends,
                                             std::uint32_t count) const {
  const std::uint32_t bits_left = take_in_ends(pairs.keys, ends, pairs.values, count);
  Pairs sorted = sort_pairs(std::move(pairs), count);
  if (bits_left > 0) {
    const shared::SortParameters parameters = make_parameters(count, device_.traits.sort_blocks);
    Launch(device_, "sort",
           device_.programs.get(program_source("kernels/sort/sort.cl")).create_kernel("sort_runs"))
        .value(parameters)
        .arg(sorted.keys)
        .arg(ends)
        .arg(sorted.values)
        .arg(sorted.scratch)
        .run_pieces(parameters.block_count);
  }
  return std::move(sorted.values);
}

// In either shape, by ends as well where there are some.
Buffer<std::uint32_t> Sorter::order_of(Pairs pairs, const Buffer<std::uint16_t>& ends,
                                       std::uint32_t count) const {
  if (count < 2) return std::move(pairs.values);
  if (groups_) return groups_->sort(std::move(pairs.keys), ends, std::move(pairs.values), count);
  return ends.size() > 0 ? sort_with_ends(std::move(pairs), ends, count)
                         : sort_pairs(std::move(pairs), count).values;
}

Buffer<std::uint32_t> Sorter::sort(Buffer<std::uint32_t> keys, const Buffer<std::uint16_t>& ends,
                                   Buffer<std::uint32_t> values, std::uint32_t count) const {
  return order_of({std::move(keys), std::move(values), {}}, ends, count);
}

SortedSplats Sorter::sort(KeyedSplats keyed) const {
  SortedSplats sorted;
  sorted.splats = std::move(keyed.splats);
  sorted.count = keyed.count;
  sorted.order = order_of({std::move(keyed.keys), std::move(keyed.order), std::move(keyed.scratch)},
                          keyed.key_ends, keyed.count);
  return sorted;
}

}  // namespace splotchcl
