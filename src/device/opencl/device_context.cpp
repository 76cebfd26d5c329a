#include "device/opencl/device_context.h"

namespace splotchcl {

DeviceContext::DeviceContext(const compute::device& chosen)
    : device(chosen),
      context(chosen),
      queue(context, chosen, compute::command_queue::enable_profiling),
      traits(traits_of(chosen)),
      programs(context),
      pool(context, queue, timer) {}

}  // namespace splotchcl
