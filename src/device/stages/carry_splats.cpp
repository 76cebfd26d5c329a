#include "device/stages/carry_splats.h"

#include "device/opencl/launch.h"
#include "parallel/for_blocks.h"
#include "scene/ceil_divide.h"

namespace splotchcl {
namespace {

// Of the values that are not above `last`.
std::vector<std::uint32_t> numbers_up_to(const MappedValues<const std::uint32_t>& values,
                                         std::uint64_t last) {
  constexpr std::size_t at_once = std::size_t{1} << 16;
  std::vector<std::vector<std::uint32_t>> of_blocks(ceil_divide(values.size(), at_once));
  for_blocks(values.size(), at_once, [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
      if (values.data()[i] <= last)
        of_blocks[first / at_once].push_back(static_cast<std::uint32_t>(i));
    }
  });
  std::vector<std::uint32_t> numbers;
  for (const std::vector<std::uint32_t>& of_block : of_blocks)
    numbers.insert(numbers.end(), of_block.begin(), of_block.end());
  return numbers;
}

}  // namespace

void carry_splats(const StageContext& context, const SortedSplats& sorted, std::uint32_t first,
                  const KeyedSplats& keyed) {
  DeviceContext& device = context.device;
  const Program program = device.programs.get(program_source("kernels/sort/carry.cl"));
  const auto copy = [&](const Buffer<std::byte>& from, const Buffer<std::byte>& to,
                        std::size_t splat_bytes) {
    Launch(device, "sort", program.create_kernel("carry_splats"))
        .value(static_cast<cl_uint>(first))
        .value(static_cast<cl_uint>(splat_bytes / sizeof(cl_uint)))
        .value(static_cast<cl_uint>(keyed.key_ends.size() > 0))
        .arg(sorted.order)
        .arg(from)
        .arg(to)
        .arg(keyed.keys)
        .arg(keyed.key_ends)
        .arg(keyed.order)
        .run_items(sorted.count - first);
  };
  const Variant& variant = context.variant;
  copy(sorted.splats.splats, keyed.splats.splats, variant.splat_bytes());
  if (variant.extended)
    copy(sorted.splats.extended, keyed.splats.extended, variant.extended_splat_bytes());
}

std::vector<std::uint64_t> sort_keys_up_to(const StageContext& context, const KeyedSplats& keyed,
                                           std::uint64_t last) {
  BufferPool& pool = context.device.pool;
  const auto upper = pool.map_to_read(keyed.keys, keyed.count);
  const std::vector<std::uint32_t> splats = numbers_up_to(upper, last >> 16);
  if (splats.empty()) return {};
  const bool has_ends = keyed.key_ends.size() > 0;
  const auto slots = pool.map_to_read(keyed.order, has_ends ? keyed.count : 0);
  const auto ends = pool.map_to_read(keyed.key_ends, keyed.key_ends.size());
  std::vector<std::uint64_t> keys;
  for (const std::uint32_t i : splats) {
    const std::uint64_t end = has_ends ? ends.data()[slots.data()[i]] : 0;
    const std::uint64_t key = std::uint64_t{upper.data()[i]} << 16 | end;
    if (key <= last) keys.push_back(key);
  }
  return keys;
}

}  // namespace splotchcl
