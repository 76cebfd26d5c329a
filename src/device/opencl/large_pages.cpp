#include "device/opencl/large_pages.h"

#include <cstddef>
#include <cstdlib>
#include <memory>

#include "scene/memory_advice.h"

namespace splotchcl {
namespace {

constexpr std::size_t large_page = std::size_t{2} << 20;
// Smaller buffers would be mostly the rest of their last page.
constexpr std::size_t least_bytes = 2 * large_page;
// Buffers that began at the same place of a small page would share lines of the nearest cache, so
// each begins so much farther: an odd number of OpenCL's largest values.
constexpr std::size_t small_page = 4096, step = 13 * 128;

struct Free {
  void operator()(void* memory) const { std::free(memory); }
};

void CL_CALLBACK free_host_memory(cl_mem, void* memory) {
  std::free(memory);
}

}  // namespace

compute::buffer LargePages::buffer(const compute::context& context, std::size_t bytes) {
  if (bytes < least_bytes) return compute::buffer(context, bytes);
  const std::size_t begin = made_++ * step % small_page;
  const std::size_t whole_pages = (begin + bytes + large_page - 1) / large_page * large_page;
  std::unique_ptr<void, Free> memory(std::aligned_alloc(large_page, whole_pages));
  if (!memory) throw compute::opencl_error(CL_MEM_OBJECT_ALLOCATION_FAILURE);
  expect_all_written(memory.get(), whole_pages);
  compute::buffer buffer(context, bytes, CL_MEM_READ_WRITE | CL_MEM_USE_HOST_PTR,
                         static_cast<std::byte*>(memory.get()) + begin);
  // Commands that still use the buffer keep it, and with it its memory.
  buffer.set_destructor_callback(&free_host_memory, memory.get());
  memory.release();
  return buffer;
}

}  // namespace splotchcl
