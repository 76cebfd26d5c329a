#pragma once

#include <cstdint>
#include <map>
#include <utility>

#include "device/opencl/device_context.h"
#include "splotchcl/particles.h"

namespace splotchcl {

// The device's view of one component's columns. On a device that shares the host's memory
// the buffers lie in the columns themselves and cost nothing.
struct ParticleBuffers {
  compute::buffer position, smoothing_length, weight, color, intensity, sort_field, own_color;
  int smoothing_length_stride = 0, weight_stride = 0, color_stride = 0, intensity_stride = 0,
      sort_stride = 0, own_color_stride = 0;
};

// Keeps columns on the device from frame to frame: a second frame of the same data moves
// nothing. A column is known by its memory, which it keeps alive.
class ParticleStore {
 public:
  explicit ParticleStore(DeviceContext& device) : device_(device) {}

  ParticleBuffers get(const Particles& particles);
  // Bytes copied to the device, without those that lie in the caller's memory.
  std::uint64_t device_bytes() const { return device_bytes_; }
  // Forgets columns that the frame now drawn has not asked for since begin_frame().
  void begin_frame() { ++frame_; }
  void end_frame();

 private:
  struct Entry {
    Column column;
    compute::buffer buffer;
    std::uint64_t bytes = 0;
    std::uint64_t frame = 0;
  };
  compute::buffer buffer_of(const Column& column, float value_if_absent, int& stride);

  DeviceContext& device_;
  std::map<std::pair<const float*, std::size_t>, Entry> entries_;
  std::map<float, compute::buffer> constants_;
  std::uint64_t device_bytes_ = 0;
  std::uint64_t frame_ = 0;
};

}  // namespace splotchcl
