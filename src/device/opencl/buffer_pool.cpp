#include "device/opencl/buffer_pool.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <string>

#include "scene/memory_advice.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

// Smaller buffers would be mostly the rest of their last page.
constexpr std::size_t least_on_large_pages = 2 * large_page_bytes;
// Buffers that began at the same place of a small page would share lines of the nearest cache, so
// each begins so much farther: an odd number of OpenCL's largest values.
constexpr std::size_t small_page = 4096, step = 13 * 128;

struct Free {
  void operator()(void* memory) const { std::free(memory); }
};

void CL_CALLBACK free_host_memory(cl_mem, void* memory) {
  std::free(memory);
}

constexpr std::uint64_t padding = 64;

// A buffer serves for less, unless it is more than twice as large: that much would lie idle.
bool serves(const compute::buffer& memory, std::uint64_t wanted) {
  return memory.size() >= wanted && memory.size() <= 2 * wanted + 4096;
}

// To one of eight sizes between two powers of two, so that buffers of almost the same size, as the
// lists of one chunk and of the next, serve for each other.
std::uint64_t rounded_up(std::uint64_t bytes) {
  std::uint64_t step = 64;
  while (bytes > 16 * step)
    step *= 2;
  return (bytes + step - 1) / step * step;
}

bool is_out_of_memory(const compute::opencl_error& error) {
  const cl_int code = error.error_code();
  return code == CL_MEM_OBJECT_ALLOCATION_FAILURE || code == CL_OUT_OF_RESOURCES ||
         code == CL_OUT_OF_HOST_MEMORY;
}

bool is_smaller(const compute::buffer& a, const compute::buffer& b) {
  return a.size() < b.size();
}

}  // namespace

compute::buffer LargePages::buffer(const compute::context& context, std::size_t bytes) {
  if (bytes < least_on_large_pages) return compute::buffer(context, bytes);
  const std::size_t begin = made_++ * step % small_page;
  const std::size_t whole_pages =
      (begin + bytes + large_page_bytes - 1) / large_page_bytes * large_page_bytes;
  std::unique_ptr<void, Free> memory(std::aligned_alloc(large_page_bytes, whole_pages));
  if (!memory) throw compute::opencl_error(CL_MEM_OBJECT_ALLOCATION_FAILURE);
  expect_all_written(memory.get(), whole_pages);
  compute::buffer buffer(context, bytes, CL_MEM_READ_WRITE | CL_MEM_USE_HOST_PTR,
                         static_cast<std::byte*>(memory.get()) + begin);
  // Commands that still use the buffer keep it, and with it its memory.
  buffer.set_destructor_callback(&free_host_memory, memory.get());
  memory.release();
  return buffer;
}

PooledMemory::~PooledMemory() {
  if (pool_ != nullptr) pool_->give_back(std::move(memory_));
}

compute::buffer BufferPool::take(std::uint64_t bytes, const char* what, Filling filling) {
  const std::uint64_t needed = std::max<std::uint64_t>(bytes, 1) + padding;
  const std::uint64_t largest = context_.get_device().max_memory_alloc_size();
  if (needed > largest) {
    throw DeviceError("device " + context_.get_device().name() + ": the " + what +
                      " buffer needs " + std::to_string(needed >> 20) + " MiB, expected at most " +
                      std::to_string(largest >> 20) +
                      " MiB: draw fewer pixels (--crop) or fewer particles");
  }
  const std::uint64_t wanted = shares_host_memory_ ? needed : std::min(rounded_up(needed), largest);
  auto best = free_.end();
  for (auto free = free_.begin(); free != free_.end(); ++free) {
    if (serves(*free, wanted) && (best == free_.end() || is_smaller(*free, *best))) best = free;
  }
  compute::buffer memory;
  if (best != free_.end()) {
    memory = std::move(*best);
    free_.erase(best);
  } else {
    release_until_it_fits(wanted);
    memory = new_buffer(static_cast<std::size_t>(wanted), filling);
    ++buffers_made_;
    total_bytes_ += wanted;
    peak_bytes_ = std::max(peak_bytes_, total_bytes_);
  }
  used_bytes_ += memory.size();
  most_used_bytes_ = std::max(most_used_bytes_, used_bytes_);
  return memory;
}

// Where the device has no memory left what lies idle makes room.
compute::buffer BufferPool::new_buffer(std::size_t bytes, Filling filling) {
  try {
    return buffer_of_device(bytes, filling);
  } catch (const compute::opencl_error& error) {
    if (!is_out_of_memory(error) || free_.empty()) throw;
  }
  queue_.finish();
  for (const compute::buffer& idle : free_)
    total_bytes_ -= idle.size();
  free_.clear();
  return buffer_of_device(bytes, filling);
}

compute::buffer BufferPool::buffer_of_device(std::size_t bytes, Filling filling) {
  if (large_pages_ && filling == Filling::whole) return large_pages_->buffer(context_, bytes);
  return compute::buffer(context_, bytes);
}

std::array<PooledMemory, 2> BufferPool::take_two(std::uint64_t bytes, const char* what) {
  // The second begins where OpenCL lets it, and not at the same line of a page as the first.
  const std::uint64_t line = std::max<std::uint64_t>(
      context_.get_device().get_info<CL_DEVICE_MEM_BASE_ADDR_ALIGN>() / 8, 1);
  const std::uint64_t part = std::max<std::uint64_t>(bytes, 1) + padding;
  const std::uint64_t second = (part / line + 2) * line;
  const auto whole =
      std::make_shared<const PooledMemory>(*this, take(second + part, what, Filling::whole));
  const auto part_from = [&](std::uint64_t first) {
    compute::buffer memory = whole->memory();
    return PooledMemory(whole,
                        memory.create_subbuffer(CL_MEM_READ_WRITE, static_cast<std::size_t>(first),
                                                static_cast<std::size_t>(part)));
  };
  return {part_from(0), part_from(second)};
}

void BufferPool::give_back(compute::buffer memory) {
  used_bytes_ -= memory.size();
  free_.push_back(std::move(memory));
}

void* BufferPool::map(const compute::buffer& memory, cl_map_flags access, std::uint64_t bytes) {
  compute::event event;
  void* const values =
      queue_.enqueue_map_buffer(memory, access, 0, static_cast<std::size_t>(bytes), event);
  timer_.add_copy(event);
  return values;
}

// What may lie idle beside what has been in use: without any, a little more that is wanted would
// cost large buffers that are needed again. Of a GPU memory_of() gives seven eighths away.
std::uint64_t BufferPool::most_idle(std::uint64_t in_use) const {
  return std::max(in_use / 32, shares_host_memory_ ? idle_bytes_ : std::min(in_use, idle_bytes_));
}

void BufferPool::release_until_it_fits(std::uint64_t wanted) {
  const std::uint64_t in_use = std::max(most_used_bytes_, used_bytes_ + wanted);
  const std::uint64_t most = in_use + most_idle(in_use);
  if (total_bytes_ + wanted <= most || free_.empty()) return;
  // Memory goes when the commands that use it have ended.
  queue_.finish();
  // The smallest first: large ones are dear to make again, since a processor touches them anew.
  std::sort(free_.begin(), free_.end(),
            [](const auto& a, const auto& b) { return is_smaller(b, a); });
  while (total_bytes_ + wanted > most && !free_.empty()) {
    total_bytes_ -= free_.back().size();
    free_.pop_back();
  }
}

}  // namespace splotchcl
