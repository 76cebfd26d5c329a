#include "device/stages/sorter.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "device/frame/shared.h"
#include "device/frame/variant.h"
#include "device/opencl/launch.h"
#include "scene/ceil_divide.h"

namespace splotchcl {
namespace {

static_assert(SORT_DIGITS == GROUP_ITEMS, "an item of a group has a digit");

static_assert(std::uint64_t{SORT_DIGITS} * ((~0u / SORT_STRETCH) + 1) < ~0u,
              "kernels count digits of all groups in 32 bits");

shared::GroupSortParameters parameters_of(std::uint32_t count) {
  shared::GroupSortParameters parameters{};
  parameters.count = count;
  parameters.group_count = sizes_of_sort(count).groups;
  return parameters;
}

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

GroupScan::GroupScan(DeviceContext& device)
    : device_(device),
      program_(device.programs.get(program_source("kernels/scan/scan_groups.cl"))),
      nothing_(device.pool.upload(std::vector<std::uint32_t>{0}, "start of a scan")) {}

void GroupScan::scan(const char* stage, const Buffer<std::uint32_t>& values,
                     std::uint32_t count) const {
  shared::ScanParameters parameters{count, 0};
  const std::uint32_t groups = ceil_divide(count, SCAN_STRETCH);
  // An empty list has a sum, too.
  if (groups <= 1) {
    Launch(device_, stage, program_.create_kernel("scan_stretches"))
        .value(parameters)
        .arg(values)
        .arg(nothing_)
        .run_groups(1, GROUP_ITEMS);
    return;
  }
  const auto sums = device_.pool.get<std::uint32_t>(std::uint64_t{groups} + 1, "sums of stretches");
  Launch(device_, stage, program_.create_kernel("scan_reduce"))
      .value(parameters)
      .arg(values)
      .arg(sums)
      .run_groups(groups, GROUP_ITEMS);
  if (groups <= SCAN_STRETCH) {
    parameters.adds_up_groups = 1;
  } else {
    scan(stage, sums, groups);
  }
  Launch(device_, stage, program_.create_kernel("scan_stretches"))
      .value(parameters)
      .arg(values)
      .arg(sums)
      .run_groups(groups, GROUP_ITEMS);
}

SortSizes sizes_of_sort(std::uint32_t count) {
  SortSizes sizes;
  sizes.groups = ceil_divide(count, SORT_STRETCH);
  sizes.counters = std::uint64_t{SORT_DIGITS} * sizes.groups;
  sizes.pair_bytes = std::uint64_t{count} * 2 * sizeof(std::uint32_t);
  sizes.counter_bytes = (sizes.counters + 1) * sizeof(std::uint32_t);
  return sizes;
}

std::uint32_t bits_of(std::uint32_t value) {
  std::uint32_t bits = 0;
  for (; value != 0; value >>= 1)
    ++bits;
  return bits;
}

DigitPlan digits_of_bits(std::uint32_t bits) {
  DigitPlan plan;
  const std::uint32_t passes = ceil_divide(bits, SORT_DIGIT_BITS);
  for (std::uint32_t shift = 0, left = passes; left > 0; --left) {
    const std::uint32_t of_pass = ceil_divide(bits - shift, left);
    plan.digits.push_back({shift, of_pass});
    shift += of_pass;
  }
  return plan;
}

DigitPlan digits_of_range(const shared::KeyRange& range) {
  DigitPlan above_smallest = digits_of_bits(bits_of(range.largest - range.smallest));
  above_smallest.smallest = range.smallest;
  const std::uint32_t differing = range.bits.some & ~range.bits.all;
  DigitPlan where_they_differ;
  for (std::uint32_t shift = 0; shift < 32; shift += SORT_DIGIT_BITS) {
    if ((differing >> shift) % SORT_DIGITS != 0)
      where_they_differ.digits.push_back({shift, SORT_DIGIT_BITS});
  }
  return where_they_differ.digits.size() < above_smallest.digits.size() ? where_they_differ
                                                                        : above_smallest;
}

GroupSorter::GroupSorter(DeviceContext& device)
    : device_(device),
      scan_(device),
      program_(device.programs.get(program_source("kernels/sort/sort_groups.cl"))) {}

KeyedValues GroupSorter::sort(const char* stage, KeyedValues pairs, std::uint32_t count,
                              const DigitPlan& plan) const {
  if (count == 0 || plan.digits.empty()) return pairs;
  BufferPool& pool = device_.pool;
  shared::GroupSortParameters parameters = parameters_of(count);
  const std::uint64_t counters = sizes_of_sort(count).counters;
  const auto histograms = pool.get<std::uint32_t>(counters + 1, "sort histogram");
  KeyedValues to = {pool.get<std::uint32_t>(count, "sort keys"),
                    pool.get<std::uint32_t>(count, "order")};
  parameters.smallest = plan.smallest;
  for (const DigitPlan::Digit& digit : plan.digits) {
    parameters.shift = digit.shift;
    parameters.bits = digit.bits;
    Launch(device_, stage, program_.create_kernel("sort_count"))
        .value(parameters)
        .arg(pairs.keys)
        .arg(histograms)
        .run_groups(parameters.group_count, GROUP_ITEMS);
    scan_.scan(stage, histograms, parameters.group_count << digit.bits);
    Launch(device_, stage, program_.create_kernel("sort_scatter"))
        .value(parameters)
        .arg(pairs.keys)
        .arg(pairs.values)
        .arg(histograms)
        .arg(to.keys)
        .arg(to.values)
        .run_groups(parameters.group_count, GROUP_ITEMS);
    std::swap(pairs, to);
    parameters.smallest = 0;
  }
  return pairs;
}

shared::KeyRange GroupSorter::find_range(const Buffer<std::uint32_t>& keys,
                                         std::uint32_t count) const {
  const shared::KeyRange none = {~0u, 0, {0, ~0u}};
  const auto range = device_.pool.upload(std::vector{none}, "range of keys");
  const shared::GroupSortParameters parameters = parameters_of(count);
  Launch(device_, "sort", program_.create_kernel("sort_range"))
      .value(parameters)
      .arg(keys)
      .arg(range)
      .run_groups(parameters.group_count, GROUP_ITEMS);
  return device_.pool.download(range, 1).front();
}

// Keys of 48 bits: their upper bits that are 0 above the smallest make room for ends.
std::uint32_t GroupSorter::join_ends(const Buffer<std::uint32_t>& keys,
                                     const Buffer<std::uint16_t>& ends,
                                     const Buffer<std::uint32_t>& values, std::uint32_t count,
                                     std::uint32_t& bits) const {
  const shared::KeyRange range = find_range(keys, count);
  const std::uint32_t upper_bits = bits_of(range.largest - range.smallest);
  shared::GroupSortParameters parameters = parameters_of(count);
  parameters.smallest = range.smallest;
  parameters.shift = std::min(16u, 32 - upper_bits);
  bits = upper_bits + parameters.shift;
  Launch(device_, "sort", program_.create_kernel("sort_join_ends"))
      .value(parameters)
      .arg(ends)
      .arg(values)
      .arg(keys)
      .run_groups(ceil_divide(count, GROUP_ITEMS), GROUP_ITEMS);
  return parameters.shift;
}

Buffer<std::uint32_t> GroupSorter::sort(Buffer<std::uint32_t> keys,
                                        const Buffer<std::uint16_t>& ends,
                                        Buffer<std::uint32_t> values, std::uint32_t count) const {
  if (count < 2) return values;
  if (ends.size() == 0) {
    const DigitPlan of_keys = digits_of_range(find_range(keys, count));
    return sort("sort", {std::move(keys), std::move(values)}, count, of_keys).values;
  }
  std::uint32_t bits = 0;
  const std::uint32_t bits_of_ends = join_ends(keys, ends, values, count, bits);
  const DigitPlan plan = digits_of_bits(bits);
  KeyedValues sorted = sort("sort", {std::move(keys), std::move(values)}, count, plan);
  // Hardly any keys agree in the bits that were sorted by, and seldom more than a few.
  if (bits_of_ends == 16 || !sort_short_runs(sorted, ends, count)) return std::move(sorted.values);
  return sort("sort", order_by_ends(sorted, ends, count), count, plan).values;
}

// Whether some were too long for it.
bool GroupSorter::sort_short_runs(const KeyedValues& pairs, const Buffer<std::uint16_t>& ends,
                                  std::uint32_t count) const {
  const auto has_long_runs = device_.pool.upload(std::vector<std::uint32_t>{0}, "long runs");
  Launch(device_, "sort", program_.create_kernel("sort_short_runs"))
      .value(parameters_of(count))
      .arg(pairs.keys)
      .arg(ends)
      .arg(pairs.values)
      .arg(has_long_runs)
      .run_groups(ceil_divide(count, GROUP_ITEMS), GROUP_ITEMS);
  return device_.pool.download(has_long_runs, 1).front() != 0;
}

KeyedValues GroupSorter::order_by_ends(const KeyedValues& pairs, const Buffer<std::uint16_t>& ends,
                                       std::uint32_t count) const {
  BufferPool& pool = device_.pool;
  const shared::GroupSortParameters parameters = parameters_of(count);
  const std::size_t groups = ceil_divide(count, GROUP_ITEMS);
  KeyedValues places = {pool.get<std::uint32_t>(count, "ends"),
                        pool.get<std::uint32_t>(count, "places")};
  Launch(device_, "sort", program_.create_kernel("sort_take_ends"))
      .value(parameters)
      .arg(pairs.values)
      .arg(ends)
      .arg(places.keys)
      .arg(places.values)
      .run_groups(groups, GROUP_ITEMS);
  places = sort("sort", std::move(places), count, digits_of_bits(16));
  KeyedValues in_order = {pool.get<std::uint32_t>(count, "sort keys"),
                          pool.get<std::uint32_t>(count, "order")};
  Launch(device_, "sort", program_.create_kernel("sort_take_pairs"))
      .value(parameters)
      .arg(places.values)
      .arg(pairs.keys)
      .arg(pairs.values)
      .arg(in_order.keys)
      .arg(in_order.values)
      .run_groups(groups, GROUP_ITEMS);
  return in_order;
}

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
