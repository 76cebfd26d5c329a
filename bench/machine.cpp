#include "machine.h"

#include <cstdlib>
#include <fstream>

#include "device/opencl/device_context.h"
#include "splotchcl/error.h"
#include "table.h"

namespace splotchcl::bench {
namespace {

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(':');
    if (line.rfind("model name", 0) == 0 && colon + 2 < line.size()) return line.substr(colon + 2);
  }
  return "unknown processor";
}

}  // namespace

Machine describe_machine(const std::string& part_of_device_name) {
  const compute::device chosen = choose_device(part_of_device_name);
  Machine machine;
  machine.processor = processor_name();
  machine.device.name = chosen.name();
  machine.device.platform = chosen.platform().name();
  machine.device.driver = chosen.driver_version();
  machine.device.is_gpu = (chosen.type() & CL_DEVICE_TYPE_GPU) != 0;
  machine.device.compute_units = static_cast<int>(chosen.compute_units());
  machine.device.memory_bytes = chosen.global_memory_size();
  machine.vector_floats =
      static_cast<int>(chosen.get_info<cl_uint>(CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT));
  double loads[1] = {0};
  if (getloadavg(loads, 1) == 1) machine.load = loads[0];
  return machine;
}

std::string describe(const Machine& machine) {
  const DeviceInfo& device = machine.device;
  return "device " + device.name + " (" + device.platform + ", driver " + device.driver + ", " +
         std::to_string(device.compute_units) + " compute units, vectors of " +
         std::to_string(machine.vector_floats) + " floats), processor " + machine.processor +
         ", load " + fixed(machine.load, 1);
}

}  // namespace splotchcl::bench
