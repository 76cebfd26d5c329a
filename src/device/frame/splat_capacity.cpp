#include "device/frame/splat_capacity.h"

#include <algorithm>

#include "scene/ceil_divide.h"

namespace splotchcl {
namespace {

// Kernels number them by 32 bits.
constexpr std::uint64_t most_splats = std::uint64_t{1} << 31;

}  // namespace

std::uint64_t splat_slots(const Frame& frame, const FramePlan& plan, const DeviceTraits& traits) {
  std::uint64_t particles = 0;
  for (const DrawnComponent& component : frame.components) {
    const std::uint64_t count = component.particles.count, block = traits.project_block;
    particles += ceil_divide(count, block) * block;
  }
  return particles * static_cast<std::uint64_t>(plan.splats_per_particle);
}

std::uint64_t splat_capacity(const FramePlan& plan, const Variant& variant,
                             const PictureLayout& layout, const DeviceTraits& traits,
                             std::uint64_t memory) {
  constexpr std::uint64_t key = sizeof(std::uint32_t) + sizeof(std::uint16_t);
  constexpr std::uint64_t place = sizeof(std::uint32_t);
  constexpr std::uint64_t sorted_into = 2 * sizeof(std::uint32_t);
  const std::uint64_t splat = variant.splat_bytes();
  const std::uint64_t planes = layout.plane_floats * sizeof(float) * (plan.slabs > 0 ? 3 : 1);
  const std::uint64_t lists =
      traits.list_capacity * variant.tile_splat_bytes() + traits.sorted_chunk * (splat + place);
  // Of a chunk of particles, before they are put together (Projector::project_window).
  const std::uint64_t apart = std::uint64_t{traits.chunk_length()} *
                              static_cast<std::uint64_t>(plan.splats_per_particle) *
                              (splat + key + place);
  const std::uint64_t fixed = planes + lists + apart;
  const std::uint64_t room = memory > fixed ? memory - fixed : 0;
  const std::uint64_t in_room = room / (splat + key + place + sorted_into);
  // As many as a chunk has may be left over from the window before.
  const std::uint64_t in_window = in_room > traits.sorted_chunk ? in_room - traits.sorted_chunk : 0;
  const std::uint64_t in_buffer = std::min(most_splats, traits.largest_buffer / splat / 2);
  return std::max<std::uint64_t>(traits.sorted_chunk, std::min(in_window, in_buffer));
}

}  // namespace splotchcl
