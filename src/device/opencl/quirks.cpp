#include "device/opencl/quirks.h"

#include <algorithm>
#include <iterator>
#include <string>

namespace splotchcl {
namespace {

struct Implementation {
  const char* platform;
  cl_device_type devices;
  Quirks quirks;
};

constexpr Quirks of_pocl_processor = {true, true, true, false, true, true, true};
constexpr Quirks of_other_pocl = {true, false, false, false, false, false, false};
// It is clang, too, and refuses its builtin for prefetching.
constexpr Quirks of_nvidia = {false, false, false, true, false, false, false};

// The first that suits counts; all others keep to the standard, as far as is known.
constexpr Implementation implementations[] = {
    {"Portable Computing Language", CL_DEVICE_TYPE_CPU, of_pocl_processor},
    {"Portable Computing Language", CL_DEVICE_TYPE_ALL, of_other_pocl},
    {"NVIDIA CUDA", CL_DEVICE_TYPE_ALL, of_nvidia},
};

}  // namespace

Quirks quirks_of(const compute::device& device) {
  const std::string platform = device.platform().name();
  const auto found = std::find_if(
      std::begin(implementations), std::end(implementations), [&](const Implementation& one) {
        return platform == one.platform && (device.type() & one.devices) != 0;
      });
  return found != std::end(implementations) ? found->quirks : Quirks();
}

}  // namespace splotchcl
