#include <algorithm>
#include <cctype>
#include <exception>
#include <iterator>
#include <string>
#include <vector>

#include "device/opencl/device_context.h"
#include "device/opencl/pocl_cache.h"
#include "device/opencl/runtime_lock.h"
#include "splotchcl/error.h"
#include "splotchcl/renderer.h"

namespace splotchcl {
namespace {

std::vector<compute::device> all_devices() {
  const auto lock = lock_runtime();
  try {
    return compute::system::devices();
  } catch (const std::exception&) {
    return {};  // the loader reports "no platform" as an error
  }
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

bool is_gpu(const compute::device& device) {
  return (device.type() & CL_DEVICE_TYPE_GPU) != 0;
}

std::string names_of(const std::vector<compute::device>& devices) {
  std::string names;
  for (const compute::device& device : devices) {
    names += (names.empty() ? "" : ", ") + device.name();
  }
  return names;
}

// A GPU if there is one, else the first of the others.
std::size_t default_index(const std::vector<compute::device>& devices) {
  const auto gpu = std::find_if(devices.begin(), devices.end(), is_gpu);
  return gpu == devices.end() ? 0 : static_cast<std::size_t>(gpu - devices.begin());
}

compute::device one_like(const compute::device& first, const std::vector<compute::device>& devices,
                         int which) {
  std::vector<compute::device> alike;
  std::copy_if(devices.begin(), devices.end(), std::back_inserter(alike),
               [&](const compute::device& device) {
                 return device.name() == first.name() &&
                        device.platform().id() == first.platform().id();
               });
  return alike[static_cast<std::size_t>(which) % alike.size()];
}

}  // namespace

std::string full_name_of(const compute::device& device) {
  return device.platform().name() + " " + device.name();
}

std::string no_device_advice() {
  if (const std::string folder = unwritable_pocl_cache(); !folder.empty()) {
    return "no OpenCL device found, and PoCL has none where it cannot write to its cache folder, "
           "found " +
           folder +
           ": name one that can be written to in the environment, POCL_CACHE_DIR, or "
           "install the OpenCL driver of your GPU";
  }
  return "no OpenCL device found, expected at least one: install PoCL, which runs on any "
         "processor (Debian: apt-get install pocl-opencl-icd), or the OpenCL driver of your GPU";
}

std::vector<DeviceInfo> list_devices() {
  const std::vector<compute::device> devices = all_devices();
  std::vector<DeviceInfo> list;
  for (const compute::device& device : devices) {
    DeviceInfo info;
    info.name = device.name();
    info.platform = device.platform().name();
    info.driver = device.driver_version();
    info.is_gpu = is_gpu(device);
    info.compute_units = static_cast<int>(device.compute_units());
    info.memory_bytes = device.global_memory_size();
    list.push_back(info);
  }
  if (!list.empty()) list[default_index(devices)].is_default = true;
  return list;
}

compute::device choose_device(const std::string& part_of_name, int which) {
  const std::vector<compute::device> devices = all_devices();
  if (devices.empty()) throw DeviceError(no_device_advice());
  if (part_of_name.empty()) return one_like(devices[default_index(devices)], devices, which);
  const std::string wanted = lower(part_of_name);
  for (const compute::device& device : devices) {
    if (lower(full_name_of(device)).find(wanted) != std::string::npos)
      return one_like(device, devices, which);
  }
  throw UsageError("--device: found '" + part_of_name +
                   "', expected a part of the name of one of: " + names_of(devices));
}

}  // namespace splotchcl
