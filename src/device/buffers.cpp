#include "device/buffers.h"

#include <algorithm>

#include "splotchcl/error.h"

namespace splotchcl {

compute::buffer Buffers::get(const std::string& name, std::uint64_t bytes) {
  // Padded, so that rows of eight may be read across the end.
  const std::uint64_t wanted = std::max<std::uint64_t>(bytes, 1) + 64;
  const auto found = buffers_.find(name);
  if (found != buffers_.end() && found->second.size() >= wanted) return found->second;
  buffers_.erase(name);
  const std::uint64_t largest = context_.get_device().max_memory_alloc_size();
  if (wanted > largest) {
    throw DeviceError("device " + context_.get_device().name() + ": the " + name +
                      " buffer needs " + std::to_string(wanted >> 20) + " MiB, expected at most " +
                      std::to_string(largest >> 20) +
                      " MiB: draw fewer pixels (--crop) or fewer particles");
  }
  compute::buffer buffer(context_, static_cast<std::size_t>(wanted));
  buffers_.emplace(name, buffer);
  peak_bytes_ = std::max(peak_bytes_, total_bytes());
  return buffer;
}

std::uint64_t Buffers::total_bytes() const {
  std::uint64_t total = 0;
  for (const auto& [name, buffer] : buffers_)
    total += buffer.size();
  return total;
}

}  // namespace splotchcl
