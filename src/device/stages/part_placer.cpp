#include "device/stages/part_placer.h"

#include "device/opencl/launch.h"

namespace splotchcl {

PartPlacer::PartPlacer(const StageContext& context, const KeyParts& parts, std::uint32_t blocks,
                       std::uint32_t stride)
    : context_(context),
      part_of_bin_(context.device.pool.upload(parts.part_of_bin, "parts of keys")) {
  parameters_.stride = stride;
  parameters_.part_count = static_cast<std::uint32_t>(parts.parts.size());
  parameters_.first_key = parts.first_key;
  parameters_.shift = parts.shift;
  parts_.first_slots = context.device.pool.get<std::uint32_t>(
      std::uint64_t{blocks} * (parameters_.part_count + 1), "runs of parts");
  parts_.block_count = blocks;
  parts_.keys = parts.parts;
}

void PartPlacer::place(const KeyedSplats& apart, const Buffer<shared::BlockCounts>& counts,
                       std::uint32_t first_block, std::uint32_t block_count,
                       const KeyedSplats& keyed) {
  DeviceContext& device = context_.device;
  parameters_.first_block = first_block;
  parameters_.block_count = block_count;
  parameters_.has_ends = keyed.key_ends.size() > 0;
  const Program program = device.programs.get(context_.specialization.key_parts());
  Launch(device, "project", program.create_kernel("place_in_parts"))
      .value(parameters_)
      .arg(counts)
      .arg(apart.splats.splats)
      .arg(apart.keys)
      .arg(apart.key_ends)
      .arg(part_of_bin_)
      .arg(keyed.splats.splats)
      .arg(keyed.keys)
      .arg(keyed.key_ends)
      .arg(parts_.first_slots)
      .run_pieces(block_count);
}

}  // namespace splotchcl
