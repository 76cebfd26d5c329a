#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "device/opencl/device_traits.h"
#include "device/opencl/opencl.h"
#include "device/opencl/stage_timer.h"

namespace splotchcl {

// Makes a processor's buffers in memory that the system is asked to put on pages of 2 MiB, where it
// has such: they are made with a five-hundredth of the interruptions of small ones, and splats that
// lie all over hundreds of megabytes are found without a walk through tables of pages for each.
// What is too small for that, and what the system refuses, lies on small pages. For devices that
// use the host's memory at any address (DeviceTraits::large_pages).
class LargePages {
 public:
  // Throws compute::opencl_error where there is no such memory.
  compute::buffer buffer(const compute::context& context, std::size_t bytes);

 private:
  std::size_t made_ = 0;
};

class BufferPool;

// A stretch of device memory from a pool, which gets it back when the buffer goes. Commands
// run in order, so what was given back may serve the next command at once.
class PooledMemory {
 public:
  PooledMemory() = default;
  PooledMemory(BufferPool& pool, compute::buffer memory)
      : pool_(&pool), memory_(std::move(memory)) {}
  // A part of what goes back when its last part does.
  PooledMemory(std::shared_ptr<const PooledMemory> whole, compute::buffer part)
      : whole_(std::move(whole)), memory_(std::move(part)) {}
  PooledMemory(PooledMemory&& other) noexcept
      : pool_(std::exchange(other.pool_, nullptr)),
        whole_(std::move(other.whole_)),
        memory_(std::move(other.memory_)) {}
  PooledMemory& operator=(PooledMemory&& other) noexcept {
    std::swap(pool_, other.pool_);
    std::swap(whole_, other.whole_);
    std::swap(memory_, other.memory_);
    return *this;
  }
  ~PooledMemory();

  const compute::buffer& memory() const { return memory_; }

 private:
  BufferPool* pool_ = nullptr;
  std::shared_ptr<const PooledMemory> whole_;
  compute::buffer memory_;
};

// Values of one type in device memory. Their contents are undefined at first.
template <class T>
class Buffer {
 public:
  Buffer() = default;  // none
  Buffer(PooledMemory memory, std::uint64_t size) : memory_(std::move(memory)), size_(size) {}

  std::uint64_t size() const { return size_; }
  const compute::buffer& memory() const { return memory_.memory(); }

 private:
  PooledMemory memory_;
  std::uint64_t size_ = 0;
};

// A buffer's values for as long as the host has them: on a device in the host's own memory without
// a copy, else in the host's. Commands see what was written once this has gone.
template <class T>
class MappedValues {
 public:
  using Value = std::remove_const_t<T>;
  // Those that are mapped.
  MappedValues(compute::command_queue queue, compute::buffer memory, void* values,
               std::size_t count)
      : queue_(std::move(queue)), memory_(std::move(memory)), mapped_(values), size_(count) {}
  // Copies.
  MappedValues(compute::command_queue queue, compute::buffer memory, std::vector<Value> copies)
      : queue_(std::move(queue)),
        memory_(std::move(memory)),
        copies_(std::move(copies)),
        size_(copies_.size()) {}
  MappedValues(const MappedValues&) = delete;
  MappedValues& operator=(const MappedValues&) = delete;
  ~MappedValues() {
    // Commands that follow fail where these do.
    if (mapped_ != nullptr) {
      clEnqueueUnmapMemObject(queue_.get(), memory_.get(), mapped_, 0, nullptr, nullptr);
    } else if (!std::is_const_v<T> && size_ > 0) {
      clEnqueueWriteBuffer(queue_.get(), memory_.get(), CL_TRUE, 0, size_ * sizeof(T),
                           copies_.data(), 0, nullptr, nullptr);
    }
  }

  T* data() const {
    return mapped_ != nullptr ? static_cast<T*>(mapped_) : const_cast<T*>(copies_.data());
  }
  std::size_t size() const { return size_; }

 private:
  compute::command_queue queue_;
  compute::buffer memory_;
  void* mapped_ = nullptr;
  std::vector<Value> copies_;
  std::size_t size_;
};

// How much of a buffer is written to. Room of which parts stay as they are has no memory there on a
// processor, as long as it lies on small pages.
enum class Filling { whole, in_parts };

// The device's working memory. Buffers that came back are handed out again, and what is held in all
// never exceeds what has been in use at one time by more than a thirty-second part, or 32 MiB: a
// small frame has buffers of many sizes, and where the next one had to make them anew it would wait
// for the system to clear them. On GPUs it exceeds that by no more than as much again and a
// sixteenth of their memory: to make a buffer there and to give it back takes as long as many
// kernels.
class BufferPool {
 public:
  // So many bytes may lie idle on a processor, whatever has been in use.
  static constexpr std::uint64_t idle_on_processors = std::uint64_t{32} << 20;

  // `timer` is told of what is copied.
  BufferPool(const compute::context& context, const compute::command_queue& queue,
             StageTimer& timer, const DeviceTraits& traits)
      : context_(context),
        queue_(queue),
        timer_(timer),
        shares_host_memory_(traits.shares_host_memory),
        idle_bytes_(traits.shares_host_memory ? idle_on_processors : traits.gpu_memory / 16) {
    if (traits.large_pages) large_pages_.emplace();
  }
  BufferPool(const BufferPool&) = delete;
  BufferPool& operator=(const BufferPool&) = delete;

  // No more than a thirty-second part of it lies idle, where the whole may be in use at one time.
  void expect_at_most(std::uint64_t bytes) { idle_bytes_ = std::min(idle_bytes_, bytes / 32); }

  // Room for `count` values, and 64 bytes more, so that rows of eight may be read across the
  // end. Throws DeviceError, which calls the buffer `what`, where the device has not as much.
  template <class T>
  Buffer<T> get(std::uint64_t count, const char* what, Filling filling = Filling::whole) {
    return {PooledMemory(*this, take(count * sizeof(T), what, filling)), count};
  }
  // Two of `count` values each that lie in one stretch of memory. It comes back when both have: so
  // it serves larger buffers then, which neither of two apart would.
  template <class T>
  std::array<Buffer<T>, 2> get_two(std::uint64_t count, const char* what) {
    std::array<PooledMemory, 2> parts = take_two(count * sizeof(T), what);
    return {Buffer<T>(std::move(parts[0]), count), Buffer<T>(std::move(parts[1]), count)};
  }
  template <class T>
  Buffer<T> upload(const std::vector<T>& values, const char* what) {
    return upload(values.data(), values.size(), what);
  }
  template <class T>
  Buffer<T> upload(const T* values, std::size_t count, const char* what) {
    Buffer<T> buffer = get<T>(count, what);
    if (count > 0) {
      timer_.add_copy(queue_.enqueue_write_buffer(buffer.memory(), 0, count * sizeof(T), values));
    }
    return buffer;
  }
  // The first `count` values; waits for the commands before.
  template <class T>
  std::vector<T> download(const Buffer<T>& buffer, std::size_t count) {
    std::vector<T> values(count);
    if (count > 0) {
      timer_.add_copy(
          queue_.enqueue_read_buffer(buffer.memory(), 0, count * sizeof(T), values.data()));
    }
    return values;
  }

  // The first `count` values, to be read, or all values of a buffer, to be written anew; both wait
  // for the commands before. A GPU's driver would make memory that it can copy to each time.
  template <class T>
  MappedValues<const T> map_to_read(const Buffer<T>& buffer, std::uint64_t count) {
    const auto size = static_cast<std::size_t>(count);
    if (!shares_host_memory_ || size == 0) return {queue_, buffer.memory(), download(buffer, size)};
    return {queue_, buffer.memory(), map(buffer.memory(), CL_MAP_READ, size * sizeof(T)), size};
  }
  template <class T>
  MappedValues<const T> map_to_read(const Buffer<T>& buffer) {
    return map_to_read(buffer, buffer.size());
  }
  template <class T>
  MappedValues<T> map_to_write(const Buffer<T>& buffer) {
    const auto count = static_cast<std::size_t>(buffer.size());
    if (!shares_host_memory_) return {queue_, buffer.memory(), std::vector<T>(count)};
    return {queue_, buffer.memory(),
            map(buffer.memory(), CL_MAP_WRITE_INVALIDATE_REGION, count * sizeof(T)), count};
  }

  // Values from number `first` on, of memory that is there; both wait for it.
  template <class T>
  void write(const Buffer<T>& buffer, std::uint64_t first, const T* values, std::size_t count) {
    if (count == 0) return;
    timer_.add_copy(
        queue_.enqueue_write_buffer(buffer.memory(), first * sizeof(T), count * sizeof(T), values));
  }
  template <class T>
  void read(const Buffer<T>& buffer, std::uint64_t first, T* values, std::size_t count) {
    if (count == 0) return;
    timer_.add_copy(
        queue_.enqueue_read_buffer(buffer.memory(), first * sizeof(T), count * sizeof(T), values));
  }

  // The largest total since reset_peak().
  std::uint64_t peak_bytes() const { return peak_bytes_; }
  void reset_peak() { peak_bytes_ = total_bytes_; }
  // Buffers that the device had to make: a frame like the one before needs none.
  std::uint64_t buffers_made() const { return buffers_made_; }

 private:
  friend class PooledMemory;
  compute::buffer take(std::uint64_t bytes, const char* what, Filling filling);
  compute::buffer new_buffer(std::size_t bytes, Filling filling);
  compute::buffer buffer_of_device(std::size_t bytes, Filling filling);
  std::array<PooledMemory, 2> take_two(std::uint64_t bytes, const char* what);
  void give_back(compute::buffer memory);
  void* map(const compute::buffer& memory, cl_map_flags access, std::uint64_t bytes);
  std::uint64_t most_idle(std::uint64_t in_use) const;
  void release_until_it_fits(std::uint64_t wanted);

  compute::context context_;
  compute::command_queue queue_;
  StageTimer& timer_;
  bool shares_host_memory_;
  std::uint64_t idle_bytes_;  // that may lie idle however little has been in use
  std::optional<LargePages> large_pages_;
  std::vector<compute::buffer> free_;
  std::uint64_t buffers_made_ = 0;
  std::uint64_t used_bytes_ = 0, total_bytes_ = 0;  // total: used and free
  std::uint64_t most_used_bytes_ = 0, peak_bytes_ = 0;
};

}  // namespace splotchcl
