#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "device/frame/records.h"
#include "device/frame/shared.h"
#include "device/opencl/device_context.h"

namespace splotchcl {

// Exclusive sums of lists in the shape for GPUs, in as many steps as their length has factors of
// 2048: reduce, scan, add, of which the middle one is left out where it has no more than 2048 sums:
// each group adds up those before it. No list is walked by a single work-item.
class GroupScan {
 public:
  explicit GroupScan(DeviceContext& device);

  // In place: values[i] becomes the sum of those before it, and values[count], for which there is
  // room, that of all. Below 2^32; `stage` as in Launch.
  void scan(const char* stage, const Buffer<std::uint32_t>& values, std::uint32_t count) const;

 private:
  DeviceContext& device_;
  Program program_;
  Buffer<std::uint32_t> nothing_;  // what is before the first stretch
};

struct KeyedValues {
  Buffer<std::uint32_t> keys, values;
};

// The passes of a radix sort: `smallest` is subtracted first, and bits that are in no digit are
// the same in all keys.
struct DigitPlan {
  struct Digit {
    std::uint32_t shift = 0, bits = 0;
  };
  std::uint32_t smallest = 0;
  std::vector<Digit> digits;
};

// How many a value has without zeros in front.
std::uint32_t bits_of(std::uint32_t value);
// The fewest digits of at most 8 bits for keys below 2^bits.
DigitPlan digits_of_bits(std::uint32_t bits);
// The fewest for keys in this range: those in which keys differ, or those of what they are above
// the smallest.
DigitPlan digits_of_range(const shared::KeyRange& range);

// What sorting so many pairs takes, whatever their keys: without wrapping around up to the most
// that 32 bits count.
struct SortSizes {
  std::uint32_t groups = 0;
  std::uint64_t counters = 0;  // of all groups' digits
  std::uint64_t pair_bytes = 0, counter_bytes = 0;
};
SortSizes sizes_of_sort(std::uint32_t count);

// Sorter's work in the shape for GPUs: by work-groups, each of which sorts a stretch in local
// memory.
class GroupSorter {
 public:
  explicit GroupSorter(DeviceContext& device);

  // As in Sorter.
  Buffer<std::uint32_t> sort(Buffer<std::uint32_t> keys, const Buffer<std::uint16_t>& ends,
                             Buffer<std::uint32_t> values, std::uint32_t count) const;
  // Stable, by the keys' digits; keys come back less the smallest. `stage` as in Launch.
  KeyedValues sort(const char* stage, KeyedValues pairs, std::uint32_t count,
                   const DigitPlan& plan) const;

 private:
  shared::KeyRange find_range(const Buffer<std::uint32_t>& keys, std::uint32_t count) const;
  // How many bits of the ends are in the keys then, of which those in use are returned.
  std::uint32_t join_ends(const Buffer<std::uint32_t>& keys, const Buffer<std::uint16_t>& ends,
                          const Buffer<std::uint32_t>& values, std::uint32_t count,
                          std::uint32_t& bits) const;
  bool sort_short_runs(const KeyedValues& pairs, const Buffer<std::uint16_t>& ends,
                       std::uint32_t count) const;
  KeyedValues order_by_ends(const KeyedValues& pairs, const Buffer<std::uint16_t>& ends,
                            std::uint32_t count) const;

  DeviceContext& device_;
  GroupScan scan_;
  Program program_;
};

// Stable radix sort of (key, value) pairs on the device: the stage `sort`.
class Sorter {
 public:
  explicit Sorter(DeviceContext& device, bool is_used = true);

  SortedSplats sort(KeyedSplats keyed) const;
  // The first `count` values in the order of their keys: of 32 bits where there are no ends; else
  // of 48, the upper 32 of values[i] being keys[i], the others ends[values[i]]. Of these groups
  // take the numbers 0, 1, 2, ... only.
  Buffer<std::uint32_t> sort(Buffer<std::uint32_t> keys, const Buffer<std::uint16_t>& ends,
                             Buffer<std::uint32_t> values, std::uint32_t count) const;

 private:
  // And room for as many values. Where pairs come with some, values end in the memory that they
  // came in; else in either.
  struct Pairs {
    Buffer<std::uint32_t> keys, values, scratch;
  };
  Buffer<std::uint32_t> order_of(Pairs pairs, const Buffer<std::uint16_t>& ends,
                                 std::uint32_t count) const;
  Pairs sort_pairs(Pairs pairs, std::uint32_t count) const;
  Buffer<std::uint32_t> sort_with_ends(Pairs pairs, const Buffer<std::uint16_t>& ends,
                                       std::uint32_t count) const;
  std::uint32_t take_in_ends(const Buffer<std::uint32_t>& keys, const Buffer<std::uint16_t>& ends,
                             const Buffer<std::uint32_t>& values, std::uint32_t count) const;

  DeviceContext& device_;
  std::optional<GroupSorter> groups_;  // does the work in its shape
};

}  // namespace splotchcl
