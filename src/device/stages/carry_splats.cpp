#include "device/stages/carry_splats.h"

#include "device/opencl/launch.h"

namespace splotchcl {

void carry_splats(const StageContext& context, const SortedSplats& sorted, std::uint32_t first,
                  const KeyedSplats& keyed) {
  DeviceContext& device = context.device;
  const Program program = device.programs.get(Specialization::carry());
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
  const Specialization& specialization = context.specialization;
  copy(sorted.splats.splats, keyed.splats.splats, specialization.splat_bytes());
  if (specialization.is_extended())
    copy(sorted.splats.extended, keyed.splats.extended, specialization.extended_splat_bytes());
}

std::vector<std::uint64_t> sort_keys_of(const StageContext& context, const KeyedSplats& keyed) {
  BufferPool& pool = context.device.pool;
  const bool has_ends = keyed.key_ends.size() > 0;
  const std::vector<std::uint32_t> upper = pool.download(keyed.keys, keyed.count);
  const std::vector<std::uint32_t> slots = pool.download(keyed.order, has_ends ? keyed.count : 0);
  const std::vector<std::uint16_t> ends =
      pool.download(keyed.key_ends, static_cast<std::size_t>(keyed.key_ends.size()));
  std::vector<std::uint64_t> keys(upper.size());
  for (std::size_t i = 0; i < keys.size(); ++i)
    keys[i] = std::uint64_t{upper[i]} << 16 | (has_ends ? ends[slots[i]] : 0);
  return keys;
}

}  // namespace splotchcl
