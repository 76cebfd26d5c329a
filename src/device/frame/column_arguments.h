#pragma once

#include "device/frame/particle_store.h"
#include "device/frame/shared.h"
#include "device/opencl/launch.h"

namespace splotchcl {

// What kernels that read columns of particles take (kernels/project/load.cl): the strides, among
// the parameters, and the buffers, from positions to sort fields. The particles' own colors are an
// argument of their own, where a component has some.
void set_strides(const ParticleBuffers& particles, shared::ProjectLaunch& launch);
Launch& pass_columns(Launch& launch, const ParticleBuffers& particles);

}  // namespace splotchcl
