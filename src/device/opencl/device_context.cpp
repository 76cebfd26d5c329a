#include "device/opencl/device_context.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <exception>
#include <iterator>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "device/opencl/device_traits.h"
#include "device/opencl/launch.h"
#include "device/opencl/pocl_cache.h"
#include "device/opencl/runtime_lock.h"
#include "kernels/common/group.h"
#include "parallel/available_memory.h"
#include "splotchcl/error.h"
#include "splotchcl/renderer.h"

namespace splotchcl {
namespace {

// Two in three of what the error budget counts of the polynomial (splat_limits.cpp), since an error
// may be larger between the places that are tried.
constexpr double most_error = 1.8e-6;
constexpr double lowest = -126;

std::vector<float> places() {
  constexpr int in_each_half = 1 << 15;
  std::vector<float> t;
  for (int i = 0; i < in_each_half; ++i) {
    const double part = static_cast<double>(i) / in_each_half;
    t.push_back(static_cast<float>(-part));
    t.push_back(static_cast<float>(lowest * part));
  }
  t.push_back(static_cast<float>(lowest));
  while (t.size() % GROUP_ITEMS != 0)
    t.push_back(static_cast<float>(lowest - static_cast<double>(t.size() % GROUP_ITEMS)));
  return t;
}

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

DeviceQueue::DeviceQueue(const compute::device& device)
    : context(device), queue(context, device, compute::command_queue::enable_profiling) {}

std::shared_ptr<DeviceQueue> open_queue(const compute::device& device) {
  const auto lock = lock_runtime();
  if (!quirks_of(device).needs_one_queue) return std::make_shared<DeviceQueue>(device);
  static std::map<cl_device_id, std::weak_ptr<DeviceQueue>> queues;
  std::weak_ptr<DeviceQueue>& known = queues[device.id()];
  std::shared_ptr<DeviceQueue> shared = known.lock();
  if (!shared) known = shared = std::make_shared<DeviceQueue>(device);
  return shared;
}

// A processor shares its memory with files that are mapped and with other programs, a GPU with
// the particles' columns.
DeviceMemory memory_of(const compute::device& device, const DeviceTraits& traits) {
  if (traits.shares_host_memory) return {available_memory() / 4 * 3, ~std::uint64_t{0}};
  const std::uint64_t all = device.global_memory_size();
  return {all / 2, all / 8 * 3};
}

DeviceContext::DeviceContext(const compute::device& chosen)
    : device(chosen),
      opened(open_queue(chosen)),
      context(opened->context),
      queue(opened->queue),
      traits(traits_of(chosen)),
      memory(memory_of(chosen, traits)),
      programs(context),
      pool(context, queue, timer, traits),
      copies(context, queue, timer, traits) {
  if (traits.is_gpu) traits.native_exp2 = native_exp2_serves(*this);
}

void DeviceContext::limit_memory(std::uint64_t bytes) {
  memory.total = bytes;
  pool.expect_at_most(bytes);
}

double error_of_native_exp2(DeviceContext& device) {
  const std::vector<float> t = places();
  const auto values = device.pool.get<float>(t.size(), "tried values");
  Launch(device, "open",
         device.programs.get(program_source("kernels/composite/try_native_exp2.cl"))
             .create_kernel("try_native_exp2"))
      .arg(device.pool.upload(t, "tried places"))
      .arg(values)
      .run_groups(t.size() / GROUP_ITEMS, GROUP_ITEMS);
  const std::vector<float> found = device.pool.download(values, t.size());
  device.timer.clear();
  double largest = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double expected = std::exp2(std::max(static_cast<double>(t[i]), lowest));
    const double value = static_cast<double>(found[i]);
    const bool is_below = static_cast<double>(t[i]) < lowest;
    const double error =
        is_below ? (std::abs(value) <= expected ? 0 : std::numeric_limits<double>::infinity())
                 : std::abs(value / expected - 1);
    largest = error >= 0 ? std::max(largest, error) : std::numeric_limits<double>::infinity();
  }
  return largest;
}

bool native_exp2_serves(DeviceContext& device) {
  return error_of_native_exp2(device) <= most_error;
}

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
