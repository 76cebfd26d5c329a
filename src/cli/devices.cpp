#include <fmt/format.h>

#include <iostream>

#include "cli/commands.h"
#include "cli/json_answer.h"
#include "splotchcl/error.h"
#include "splotchcl/renderer.h"

namespace splotchcl::cli {
namespace {

Json json_of_device(const DeviceInfo& device) {
  return {{"name", device.name},
          {"platform", device.platform},
          {"driver", device.driver},
          {"is_gpu", device.is_gpu},
          {"compute_units", device.compute_units},
          {"memory_bytes", device.memory_bytes},
          {"is_default", device.is_default}};
}

std::string to_text(const DeviceInfo& device) {
  constexpr double gibibyte = 1024.0 * 1024 * 1024;
  return fmt::format("{} {}\n    {}, driver {}; {}, {} compute units, {:.1f} GiB\n",
                     device.is_default ? '*' : ' ', device.name, device.platform, device.driver,
                     device.is_gpu ? "GPU" : "CPU", device.compute_units,
                     static_cast<double>(device.memory_bytes) / gibibyte);
}

}  // namespace

int run_devices(const DevicesOptions& options) {
  const std::vector<DeviceInfo> devices = list_devices();
  if (options.json) {
    print_json_list(devices, json_of_device);
  }
  if (devices.empty()) throw DeviceError(no_device_advice());
  if (options.json) return 0;
  for (const DeviceInfo& device : devices)
    std::cout << to_text(device);
  std::cout << "* is used unless --device names a part of another's name.\n";
  return 0;
}

}  // namespace splotchcl::cli
