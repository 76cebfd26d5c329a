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

struct Pairs {
  Buffer<std::uint32_t> keys, values;
};

}  // namespace

Buffer<std::uint32_t> Sorter::sort(Buffer<std::uint32_t> keys, Buffer<std::uint32_t> values,
                                   std::uint32_t count) const {
  if (count < 2) return values;
  BufferPool& pool = device_.pool;
  shared::SortParameters parameters = make_parameters(count, device_.traits.sort_blocks);
  const auto histograms = pool.get<std::uint32_t>(
      std::uint64_t{SORT_DIGITS} * parameters.block_count, "sort histogram");
  const auto bits = pool.get<shared::KeyBits>(parameters.block_count, "key bits");
  Pairs from = {std::move(keys), std::move(values)};
  Pairs to = {pool.get<std::uint32_t>(count, "sort keys"), pool.get<std::uint32_t>(count, "order")};
  const compute::program program = device_.programs.get(Specialization::sort());
  std::uint32_t differing = ~0u;  // until the first pass has seen the keys
  for (std::uint32_t shift = 0; shift < 32; shift += SORT_DIGIT_BITS) {
    // A digit that all keys share needs no pass.
    if (shift > 0 && (differing >> shift) % SORT_DIGITS == 0) continue;
    parameters.shift = shift;
    Launch(device_, "sort", program.create_kernel("sort_histogram"))
        .value(parameters)
        .arg(from.keys)
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
        .arg(from.keys)
        .arg(from.values)
        .arg(histograms)
        .arg(to.keys)
        .arg(to.values)
        .run_items(parameters.block_count);
    std::swap(from, to);
  }
  return std::move(from.values);
}

SortedSplats Sorter::sort(KeyedSplats keyed) const {
  SortedSplats sorted;
  sorted.splats = std::move(keyed.splats);
  sorted.count = keyed.count;
  sorted.order = sort(std::move(keyed.keys), std::move(keyed.order), keyed.count);
  return sorted;
}

}  // namespace splotchcl
