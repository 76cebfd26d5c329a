#pragma once

#include <string>

#include "device/buffers.h"
#include "device/kernel_parameters.h"
#include "device/opencl.h"
#include "device/program_cache.h"
#include "device/quirks.h"
#include "device/stage_timer.h"

namespace splotchcl {

// Throws DeviceError when there is no device, UsageError when none has that name.
compute::device choose_device(const std::string& part_of_name);

// One device with its queue and what all stages share.
struct DeviceContext {
  explicit DeviceContext(const compute::device& chosen);

  compute::device device;
  compute::context context;
  compute::command_queue queue;  // in order
  DeviceTraits traits;
  ProgramCache programs;
  Buffers buffers;
  StageTimer timer;
};

// One launch: arguments in order, then run.
class Launch {
 public:
  Launch(DeviceContext& device, const char* stage, compute::kernel kernel)
      : device_(device), stage_(stage), kernel_(std::move(kernel)) {}

  Launch& arg(const compute::buffer& buffer) {
    kernel_.set_arg(next_++, buffer);
    return *this;
  }
  template <class T>
  Launch& value(const T& value) {
    kernel_.set_arg(next_++, sizeof(T), &value);
    return *this;
  }
  // A work-item per unit of serial work.
  void run_items(std::size_t items);
  // Per-pixel kernels; sizes are rounded up to whole groups.
  void run_grid(std::size_t width, std::size_t height, std::size_t depth);
  void run_rows(std::size_t rows, std::size_t items);
  void run_groups(std::size_t groups, std::size_t group_size);

 private:
  void enqueue(std::size_t dimensions, const std::size_t* global, const std::size_t* local);

  DeviceContext& device_;
  const char* stage_;
  compute::kernel kernel_;
  std::size_t next_ = 0;
};

}  // namespace splotchcl
