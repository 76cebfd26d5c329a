#pragma once

#include <cmath>
#include <cstdint>

#include "device/frame/chunks.h"
#include "device/frame/particle_store.h"
#include "device/frame/shared.h"
#include "device/frame/stage_context.h"
#include "device/opencl/launch.h"

namespace splotchcl {

// Volatile, since GCC 12 at -O3 takes the way to float and back for nothing.
inline float nearest_float(double value) {
  const volatile float nearest = static_cast<float>(value);
  return nearest;
}

// What is left of a number beyond single precision goes to the low part; of an infinite one nothing
// is.
inline shared::FloatPair pair_of(double value) {
  const float high = nearest_float(value);
  if (!std::isfinite(high)) return {high, 0};
  return {high, nearest_float(value - static_cast<double>(high))};
}

// Constants of the projection of one of the frame's components (kernels/project/project.h),
// without the particles of a launch and the strides of their columns.
shared::ProjectParameters<float> make_project_parameters(const StageContext& context,
                                                         std::uint32_t component);
// The same with a chunk of its particles, which lies in `particles`.
shared::ProjectParameters<float> make_project_parameters(const StageContext& context,
                                                         const ParticleChunk& chunk,
                                                         const ParticleBuffers& particles);

// Hands a launch the parameters as its program takes them: in extended precision as doubles.
Launch& pass_parameters(Launch& launch, const StageContext& context,
                        const shared::ProjectParameters<float>& parameters);

// Blocks of the particles of a launch.
std::uint32_t block_count(const shared::ProjectParameters<float>& parameters);

// The buffers that a chunk lies in, without the values of blocks that are known to be out of view
// where these are made as they are wanted.
ParticleBuffers particles_in_view(const StageContext& context, ParticleStore& particles,
                                  const ParticleChunk& chunk);

// The words of an integer, as kernels take it.
shared::WideInteger wide(std::uint64_t value);
shared::WideInteger wide(std::int64_t value);

// What the places of sharp splats of one of the frame's components follow from
// (kernels/project/sharp_places.cl).
shared::SharpParameters make_sharp_parameters(const StageContext& context,
                                              const DrawnComponent& component);

}  // namespace splotchcl
