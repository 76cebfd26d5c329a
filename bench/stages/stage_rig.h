#pragma once

#include <cstdint>
#include <utility>

#include "device/opencl/device_context.h"
#include "device/pipeline.h"
#include "splotchcl/plan.h"

namespace splotchcl::bench {

// One frame whose stages can be run alone, each on what the ones before it left.
class StageRig {
 public:
  StageRig(DeviceContext& device, Frame frame, const PlanOptions& options = {});

  // Every particle, as the plan takes them: in chunks for sums, at once with keys where
  // order matters.
  void project();
  // The first chunk: what binning and compositing are measured on. Returns the number of its
  // splats. Throws DeviceError where its lists do not fit into one band.
  std::uint32_t prepare_lists();
  // Binning takes what the projection counted: of sums, this comes before each.
  void project_chunk();
  void bin();
  // No light at all: before composite() and resolve().
  void clear() { planes_ = pipeline_.compositor().start(); }
  void composite();
  // Takes the planes with it.
  Image resolve();
  void finish() { device_.queue.finish(); }

  const Frame& frame() const { return frame_; }
  const TileLists& lists() const { return lists_; }
  std::uint64_t particle_count() const { return splotchcl::particle_count(frame_); }

 private:
  CountedSplats count();

  DeviceContext& device_;
  const Frame frame_;
  const FramePlan plan_;
  ParticleStore store_;
  Pipeline pipeline_;
  SplatBlocks blocks_;
  SortedSplats sorted_;
  TileLists lists_;
  Planes planes_;
};

}  // namespace splotchcl::bench
