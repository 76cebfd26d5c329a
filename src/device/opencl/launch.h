#pragma once

#include <cstddef>
#include <utility>

#include "device/opencl/device_context.h"

namespace splotchcl {

// One launch: arguments in order, then run. Times are added up under the stage's name.
class Launch {
 public:
  Launch(DeviceContext& device, const char* stage, compute::kernel kernel)
      : device_(device), stage_(stage), kernel_(std::move(kernel)) {}

  template <class T>
  Launch& arg(const Buffer<T>& buffer) {
    return arg(buffer.memory());
  }
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
  // The same where a piece is worth waiting for: with as many work-items, most of them idle, as
  // keep a thread from taking too many pieces at once (common.cl).
  void run_pieces(std::size_t pieces);
  // Per-pixel kernels; sizes are rounded up to whole groups.
  void run_grid(std::size_t width, std::size_t height, std::size_t depth);
  void run_rows(std::size_t rows, std::size_t items);
  void run_groups(std::size_t groups, std::size_t group_size);

 private:
  void enqueue(std::size_t dimensions, const std::size_t* global, const std::size_t* local);
  void note(std::size_t dimensions, const std::size_t* global, const std::size_t* local,
            const compute::event& event) const;

  DeviceContext& device_;
  const char* stage_;
  compute::kernel kernel_;
  std::size_t next_ = 0;
};

}  // namespace splotchcl
