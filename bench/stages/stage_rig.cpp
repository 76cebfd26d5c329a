#include "stages/stage_rig.h"

#include <algorithm>

#include "splotchcl/error.h"

namespace splotchcl::bench {

std::uint64_t StageRig::particle_count() const {
  std::uint64_t count = 0;
  for (const DrawnComponent& component : frame_.components)
    count += component.particles.count;
  return count;
}

void StageRig::project() {
  if (plan_.needs_sort) {
    std::vector<ParticleBuffers> buffers;
    for (const DrawnComponent& component : frame_.components)
      buffers.push_back(store_.get(component.particles));
    projector_.project_all(frame_.components, buffers);
    return;
  }
  const std::uint32_t chunk = device_.traits.chunk_blocks * device_.traits.project_block;
  for (std::uint32_t c = 0; c < frame_.components.size(); ++c) {
    const DrawnComponent& component = frame_.components[c];
    const ParticleBuffers buffers = store_.get(component.particles);
    const auto count = static_cast<std::uint32_t>(component.particles.count);
    for (std::uint32_t first = 0; first < count; first += std::min(chunk, count - first)) {
      projector_.project_chunk(component, c, buffers, first,
                               first + std::min(chunk, count - first));
    }
  }
}

std::uint32_t StageRig::prepare_lists() {
  const DrawnComponent& component = frame_.components.front();
  const ParticleBuffers buffers = store_.get(component.particles);
  const std::uint32_t chunk = device_.traits.chunk_blocks * device_.traits.project_block;
  std::uint32_t splats = 0;
  if (plan_.needs_sort) {
    const std::uint32_t count = projector_.project_all(frame_.components, {buffers});
    order_ = Sorter(device_)
                 .sort({device_.buffers.get("keys", 0), device_.buffers.get("order", 0)}, count)
                 .values;
    splats = length_ = std::min(count, chunk);
  } else {
    const std::uint32_t end =
        std::min(chunk, static_cast<std::uint32_t>(component.particles.count));
    blocks_ = projector_.project_chunk(component, 0, buffers, 0, end);
    length_ = blocks_.stride;
    const std::uint64_t before = projector_.visible_particles();
    projector_.collect_counts(blocks_);
    splats = static_cast<std::uint32_t>(projector_.visible_particles() - before);
  }
  if (!try_bin()) {
    throw DeviceError("the benchmark's chunk needs " + std::to_string(lists_.entry_count) +
                      " tile entries, more than fit into one pass: give it fewer splats");
  }
  return splats;
}

bool StageRig::try_bin() {
  if (plan_.needs_sort) return binner_.bin_order(order_, 0, length_, lists_);
  return binner_.bin_blocks(blocks_, 0, length_, lists_);
}

void StageRig::bin() {
  try_bin();
}

}  // namespace splotchcl::bench
