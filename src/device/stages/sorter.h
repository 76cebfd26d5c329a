#pragma once

#include <cstdint>
#include <optional>

#include "device/frame/records.h"
#include "device/opencl/device_context.h"
#include "device/stages/group_sorter.h"

namespace splotchcl {

// Stable radix sort of (key, value) pairs on the device: the stage `sort`.
class Sorter {
 public:
  explicit Sorter(DeviceContext& device, bool is_used = true);

  // The splats in the order of ascending keys.
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
