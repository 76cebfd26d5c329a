#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "device/opencl.h"

namespace splotchcl {

// The device's working memory: named buffers that grow and are used again, and the
// count of their bytes.
class Buffers {
 public:
  Buffers(const compute::context& context, const compute::command_queue& queue)
      : context_(context), queue_(queue) {}

  // At least `bytes` large (never empty); contents are undefined after growing.
  compute::buffer get(const std::string& name, std::uint64_t bytes);

  // A read-only buffer with these contents.
  template <class T>
  compute::buffer upload(const std::string& name, const std::vector<T>& values) {
    const std::uint64_t bytes = values.size() * sizeof(T);
    compute::buffer buffer = get(name, bytes);
    if (bytes > 0) queue_.enqueue_write_buffer(buffer, 0, bytes, values.data());
    return buffer;
  }

  void release(const std::string& name) { buffers_.erase(name); }
  std::uint64_t total_bytes() const;
  std::uint64_t peak_bytes() const { return peak_bytes_; }
  void reset_peak() { peak_bytes_ = total_bytes(); }

 private:
  compute::context context_;
  compute::command_queue queue_;
  std::map<std::string, compute::buffer> buffers_;
  std::uint64_t peak_bytes_ = 0;
};

}  // namespace splotchcl
