#include "stages/stage_rig.h"

#include <string>

#include "splotchcl/error.h"

namespace splotchcl::bench {

StageRig::StageRig(DeviceContext& device, Frame frame, const PlanOptions& options)
    : device_(device),
      frame_(std::move(frame)),
      plan_(make_plan(frame_, options)),
      store_(device),
      pipeline_(device, store_, frame_, plan_) {}

void StageRig::project() {
  if (plan_.needs_sort()) {
    pipeline_.project_all();
    return;
  }
  for (const ParticleChunk& chunk : pipeline_.particle_chunks())
    pipeline_.project(chunk);
}

CountedSplats StageRig::count() {
  if (!plan_.needs_sort()) return pipeline_.binner().count(blocks_);
  return pipeline_.binner().count(sorted_, splat_chunks(sorted_.count, 0, device_.traits).front());
}

std::uint32_t StageRig::prepare_lists() {
  std::uint32_t splats = 0;
  if (plan_.needs_sort()) {
    sorted_ = pipeline_.sorter().sort(pipeline_.project_all());
    splats = splat_chunks(sorted_.count, 0, device_.traits).front().count;
  } else {
    project_chunk();
    const ParticleChunk chunk = pipeline_.particle_chunks().front();
    splats = static_cast<std::uint32_t>(pipeline_.projector().count(blocks_, chunk).visible);
  }
  if (const std::size_t bands = count().bands.size(); bands > 1) {
    throw DeviceError("the benchmark's chunk needs " + std::to_string(bands) +
                      " bands of the picture, expected 1: give it fewer splats");
  }
  project_chunk();
  bin();
  return splats;
}

void StageRig::project_chunk() {
  if (!plan_.needs_sort()) blocks_ = pipeline_.project(pipeline_.particle_chunks().front());
}

void StageRig::bin() {
  const CountedSplats counted = count();
  lists_ = pipeline_.binner().make_lists(counted, counted.bands.front());
}

void StageRig::composite() {
  const Buffer<std::byte>& splats = plan_.needs_sort() ? sorted_.splats : blocks_.splats;
  planes_ = pipeline_.compositor().composite(lists_, splats, std::move(planes_));
}

Image StageRig::resolve() {
  return pipeline_.resolver().resolve(std::move(planes_));
}

}  // namespace splotchcl::bench
