#pragma once

#include <cstdint>
#include <vector>

#include "device/binner.h"
#include "device/compositor.h"
#include "device/device_context.h"
#include "device/frame_layout.h"
#include "device/particle_buffers.h"
#include "device/projector.h"
#include "device/resolver.h"
#include "device/sorter.h"
#include "splotchcl/plan.h"

namespace splotchcl::bench {

// One frame with its stages side by side, so that each can be run alone on what the ones
// before it left on the device.
class StageRig {
 public:
  StageRig(DeviceContext& device, Frame frame, const Plan& plan)
      : device_(device),
        frame_(std::move(frame)),
        plan_(plan),
        layout_(make_layout(frame_, plan_, device.traits.rows)),
        grids_(device.buffers.upload("grids", layout_.grids)),
        store_(device),
        projector_(device, frame_, layout_, grids_),
        binner_(device, layout_, frame_, plan_, grids_),
        compositor_(device, layout_, frame_, plan_, grids_, device.traits.rows),
        resolver_(device, layout_, frame_, plan_, grids_) {}

  // Every particle, as the plan takes them: in chunks for sums, at once with keys where
  // order matters.
  void project();
  // The first chunk that fits into one binning pass: what binning and compositing are
  // measured on. Returns the number of its splats.
  std::uint32_t prepare_lists();
  void bin();
  void clear() { compositor_.clear(); }
  void composite() { compositor_.composite(lists_); }
  Image resolve() { return resolver_.resolve(compositor_.planes(), compositor_.used_grids()); }
  void finish() { device_.queue.finish(); }

  const Frame& frame() const { return frame_; }
  const TileLists& lists() const { return lists_; }
  std::uint64_t particle_count() const;

 private:
  bool try_bin();

  DeviceContext& device_;
  Frame frame_;
  Plan plan_;
  FrameLayout layout_;
  compute::buffer grids_;
  ParticleStore store_;
  Projector projector_;
  Binner binner_;
  Compositor compositor_;
  Resolver resolver_;
  SplatBlocks blocks_;
  compute::buffer order_;
  std::uint32_t length_ = 0;  // of each block, or of all where order matters
  TileLists lists_;
};

}  // namespace splotchcl::bench
