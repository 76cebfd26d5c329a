#include "device/frame/particle_store.h"

#include <string>

#include "splotchcl/error.h"

namespace splotchcl {

compute::buffer ParticleStore::buffer_of(const Column& column, float value_if_absent, int& stride) {
  if (!column.is_array() || column.size() == 0) {
    stride = 0;
    const float value = column.is_uniform() ? column.uniform_value() : value_if_absent;
    const auto found = constants_.find(value);
    if (found != constants_.end()) return found->second;
    compute::buffer buffer(device_.context, sizeof(float));
    device_.queue.enqueue_write_buffer(buffer, 0, sizeof(float), &value);
    constants_.emplace(value, buffer);
    return buffer;
  }
  stride = 1;
  const auto key = std::make_pair(column.data(), column.size());
  const auto found = entries_.find(key);
  if (found != entries_.end()) {
    found->second.frame = frame_;
    return found->second.buffer;
  }
  const std::size_t bytes = column.size() * sizeof(float);
  const std::uint64_t largest = device_.device.max_memory_alloc_size();
  if (bytes > largest) {
    throw DeviceError("device " + device_.device.name() + ": one field of the particles has " +
                      std::to_string(bytes >> 20) + " MiB, expected at most " +
                      std::to_string(largest >> 20) +
                      " MiB: draw a part of the particles, or another device (--device)");
  }
  Entry entry;
  entry.column = column;
  entry.frame = frame_;
  // OpenCL's interface takes host memory as non-const; a read-only buffer is not written.
  void* memory = const_cast<float*>(column.data());
  if (device_.traits.shares_host_memory) {
    entry.buffer =
        compute::buffer(device_.context, bytes, CL_MEM_READ_ONLY | CL_MEM_USE_HOST_PTR, memory);
  } else {
    entry.buffer =
        compute::buffer(device_.context, bytes, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, memory);
    entry.bytes = bytes;
    device_bytes_ += bytes;
  }
  return entries_.emplace(key, std::move(entry)).first->second.buffer;
}

ParticleBuffers ParticleStore::get(const Particles& particles) {
  ParticleBuffers buffers;
  int position_stride = 0;
  buffers.position = buffer_of(particles.position, 0, position_stride);
  buffers.smoothing_length =
      buffer_of(particles.smoothing_length, 0, buffers.smoothing_length_stride);
  buffers.weight = buffer_of(particles.weight, 1, buffers.weight_stride);
  buffers.color = buffer_of(particles.color, 0, buffers.color_stride);
  buffers.intensity = buffer_of(particles.intensity, 1, buffers.intensity_stride);
  buffers.sort_field = buffer_of(particles.sort_field, 0, buffers.sort_stride);
  buffers.own_color = buffer_of(particles.color_vector, 1, buffers.own_color_stride);
  return buffers;
}

void ParticleStore::end_frame() {
  for (auto entry = entries_.begin(); entry != entries_.end();) {
    if (entry->second.frame == frame_) {
      ++entry;
      continue;
    }
    device_bytes_ -= entry->second.bytes;
    entry = entries_.erase(entry);
  }
}

}  // namespace splotchcl
