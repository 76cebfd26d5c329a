#pragma once

#include <array>
#include <cstdint>
#include <list>
#include <memory>
#include <vector>

#include "device/frame/shared.h"
#include "device/opencl/device_context.h"
#include "splotchcl/frame.h"
#include "splotchcl/particles.h"

namespace splotchcl {

struct ParticleBuffers;

// Boxes around the blocks of particles that a projection walks, for leaving out what no camera of a
// film sees. A single frame is drawn without: they are made when the same particles, whose values
// stay, are drawn in a second one, and kept as long as frames show them.
class BlockBoxes {
 public:
  using Boxes = std::vector<shared::BlockBox>;

  // Of particles that the device has in `buffers`, one box for each DeviceTraits::project_block of
  // them; null where there are none. `frame` counts frames.
  const Boxes* find(DeviceContext& device, const Particles& particles,
                    const ParticleBuffers& buffers, std::uint64_t frame);
  // Those that are known of the particles without their values.
  const Boxes& given(const std::shared_ptr<const ParticleBoxes>& boxes, std::size_t count,
                     std::uint32_t block_particles, std::uint64_t frame);
  // Forgets those that no frame from this one on has asked for.
  void forget_before(std::uint64_t frame);

 private:
  struct Known {
    Particles particles;  // keeps their memory, by which they are known
    std::uint64_t first_frame = 0, last_frame = 0;
    Boxes boxes;
  };
  struct Given {
    std::shared_ptr<const ParticleBoxes> boxes;
    std::uint64_t last_frame = 0;
    Boxes of_blocks;
  };
  std::list<Known> known_;
  std::list<Given> given_;
};

// From where in space splats reach what is drawn of a picture, as planes with room for all that the
// projection rounds: what lies beyond one of them certainly makes no splat, bright or sharp.
class ViewBounds {
 public:
  // `p` as the component is projected. Wide angles have no bounds.
  ViewBounds(const Frame& frame, const DrawnComponent& component,
             const shared::ProjectParameters<float>& p);

  // Whether none of a block's good particles makes a splat or is around the camera.
  bool leave_out(const shared::BlockBox& box) const;

 private:
  // normal * (x - camera) + of_sigma * sigma + constant < 0 where sigma is the width in lengths.
  struct Plane {
    std::array<double, 3> normal;
    double of_sigma, constant;
  };
  void add(const Vec3& normal, double of_sigma, double constant);
  void add_edges(const Frame& frame, const shared::ProjectParameters<float>& p);
  void add_limits(const Frame& frame, const shared::ProjectParameters<float>& p);

  std::array<double, 3> camera_;  // from the component's origin
  double sigma_per_h_;
  double around_;  // nearer than so many sigma, clouds are around the camera
  std::vector<Plane> planes_;
};

}  // namespace splotchcl
