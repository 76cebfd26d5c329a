#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "device/device_context.h"
#include "device/frame_layout.h"
#include "device/particle_buffers.h"
#include "splotchcl/frame.h"

namespace splotchcl {

// Blocks of slots in the splat buffer: block b starts at slot b * stride and holds as
// many splats as visible[2 b] says.
struct SplatBlocks {
  std::uint32_t block_count = 0;
  std::uint32_t stride = 0;
};

// Particles to splats: the stage `project`.
class Projector {
 public:
  Projector(DeviceContext& device, const Frame& frame, const FrameLayout& layout,
            const compute::buffer& grids);

  // Projects particles [first, end) of a component into the `splats` buffer, block by
  // block; the blocks' numbers of visible and bad particles go to `visible`.
  SplatBlocks project_chunk(const DrawnComponent& component, std::uint32_t component_index,
                            const ParticleBuffers& particles, std::uint32_t first,
                            std::uint32_t end);

  // Projects every component, densely, with sort keys and the identity permutation.
  // Returns the number of splats.
  std::uint32_t project_all(const std::vector<DrawnComponent>& components,
                            const std::vector<ParticleBuffers>& particles);

  std::uint64_t visible_particles() const { return visible_particles_; }
  std::uint64_t bad_particles() const { return bad_particles_; }
  // Adds the last chunk's counts; call once per project_chunk, when it has been drawn.
  void collect_counts(const SplatBlocks& blocks);

 private:
  compute::program program(const std::string& outputs) const;
  kernel::ProjectParameters parameters_for(const DrawnComponent& component,
                                           std::uint32_t component_index,
                                           const ParticleBuffers& particles) const;
  void make_room(std::uint64_t splats);
  void launch(const compute::program& program, const kernel::ProjectParameters& parameters,
              const ParticleBuffers& particles, const compute::buffer& offsets,
              const compute::buffer& visible, std::uint32_t block_count);

  DeviceContext& device_;
  const Frame& frame_;
  const FrameLayout& layout_;
  compute::buffer grids_;
  std::uint64_t visible_particles_ = 0;
  std::uint64_t bad_particles_ = 0;
};

}  // namespace splotchcl
