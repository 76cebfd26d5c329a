#pragma once

#include "device/opencl/device_context.h"
#include "ranks/exchange.h"
#include "splotchcl/frame.h"

namespace splotchcl {

// What a renderer refuses, with an error that says what to do.
void check_frame(const Frame& frame);
void check_ranks(const Frame& frame, const Communicator* ranks);
void require_doubles(const DeviceContext& device);

}  // namespace splotchcl
