#include "device/stages/sorter.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "device/frame/specialization.h"
#include "device/opencl/launch.h"

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
  parameters.block_length = std::max(1024u, count / wanted_blocks + (count % wanted_blocks != 0));
  parameters.block_count = count / parameters.block_length + (count % parameters.block_length != 0);
  return parameters;
}

}  // namespace

Sorter::Sorter(DeviceContext& device, bool is_used) : device_(device) {
  if (!is_used) return;
  if (device.traits.rows)
    device.programs.get(Specialization::sort());  // asked for, with those of other stages
  else
    groups_.emplace(device);
}

Sorter::Pairs Sorter::sort_pairs(Buffer<std::uint32_t> keys, Buffer<std::uint32_t> values,
                                 std::uint32_t count) const {
  BufferPool& pool = device_.pool;
  shared::SortParameters parameters = make_parameters(count, device_.traits.sort_blocks);
  const auto histograms = pool.get<std::uint32_t>(
      std::uint64_t{SORT_DIGITS} * parameters.block_count, "sort histogram");
  const auto bits = pool.get<shared::KeyBits>(parameters.block_count, "key bits");
  auto from = std::make_pair(std::move(keys), std::move(values));
  auto to = std::make_pair(pool.get<std::uint32_t>(count, "sort keys"),
                           pool.get<std::uint32_t>(count, "order"));
  const Program program = device_.programs.get(Specialization::sort());
  std::uint32_t differing = ~0u;  // until the first pass has seen the keys
  for (std::uint32_t shift = 0; shift < 32; shift += SORT_DIGIT_BITS) {
    // A digit that all keys share needs no pass.
    if (shift > 0 && (differing >> shift) % SORT_DIGITS == 0) continue;
    parameters.shift = shift;
    Launch(device_, "sort", program.create_kernel("sort_histogram"))
        .value(parameters)
        .arg(from.first)
        .arg(histograms)
        .arg(bits)
        .run_items(parameters.block_count);
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
        .arg(from.first)
        .arg(from.second)
        .arg(histograms)
        .arg(to.first)
        .arg(to.second)
        .run_items(parameters.block_count);
    std::swap(from, to);
  }
  return {std::move(from.first), std::move(from.second), std::move(to.second)};
}

Buffer<std::uint32_t> Sorter::sort(Buffer<std::uint32_t> keys, Buffer<std::uint32_t> values,
                                   std::uint32_t count) const {
  if (count < 2) return values;
  if (groups_) return groups_->sort(std::move(keys), std::move(values), count);
  return sort_pairs(std::move(keys), std::move(values), count).values;
}

// Upper bits that all keys share make room for ends. How many bits of the ends are left.
std::uint32_t Sorter::take_in_ends(const Buffer<std::uint32_t>& keys,
                                   const Buffer<std::uint16_t>& ends,
                                   const Buffer<std::uint32_t>& values, std::uint32_t count) const {
  shared::SortParameters parameters = make_parameters(count, device_.traits.sort_blocks);
  const auto bits = device_.pool.get<shared::KeyBits>(parameters.block_count, "key bits");
  const Program program = device_.programs.get(Specialization::sort());
  Launch(device_, "sort", program.create_kernel("sort_bits"))
      .value(parameters)
      .arg(keys)
      .arg(bits)
      .run_items(parameters.block_count);
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
      .run_items(parameters.block_count);
  return parameters.shift;
}

// Hardly any keys agree in their upper 32 bits, and those that do lie side by side once these
// are sorted: so their ends are neither moved nor digits of the radix sort.
Buffer<std::uint32_t> Sorter::sort(Buffer<std::uint32_t> keys, const Buffer<std::uint16_t>& ends,
                                   Buffer<std::uint32_t> values, std::uint32_t count) const {
  if (count < 2) return values;
  if (groups_) return groups_->sort(std::move(keys), ends, std::move(values), count);
  const std::uint32_t bits_left = take_in_ends(keys, ends, values, count);
  Pairs sorted = sort_pairs(std::move(keys), std::move(values), count);
  if (bits_left == 0) return std::move(sorted.values);
  const shared::SortParameters parameters = make_parameters(count, device_.traits.sort_blocks);
  Launch(device_, "sort", device_.programs.get(Specialization::sort()).create_kernel("sort_runs"))
      .value(parameters)
      .arg(sorted.keys)
      .arg(ends)
      .arg(sorted.values)
      .arg(sorted.scratch)
      .run_items(parameters.block_count);
  return std::move(sorted.values);
}

SortedSplats Sorter::sort(KeyedSplats keyed) const {
  SortedSplats sorted;
  sorted.splats = std::move(keyed.splats);
  sorted.count = keyed.count;
  const bool has_ends = keyed.key_ends.size() > 0;
  sorted.order =
      has_ends ? sort(std::move(keyed.keys), keyed.key_ends, std::move(keyed.order), keyed.count)
               : sort(std::move(keyed.keys), std::move(keyed.order), keyed.count);
  return sorted;
}

}  // namespace splotchcl
