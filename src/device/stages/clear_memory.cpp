#include "device/stages/clear_memory.h"

#include <algorithm>
#include <cstddef>

#include "device/frame/shared.h"
#include "device/frame/variant.h"
#include "device/opencl/launch.h"
#include "scene/ceil_divide.h"

namespace splotchcl {
namespace {

// Below it a thread is done before others have begun.
constexpr std::uint64_t least_shared_bytes = std::uint64_t{1} << 20;

void clear_together(DeviceContext& device, const char* stage, const compute::buffer& memory,
                    std::uint64_t first, std::uint64_t bytes) {
  // As many words as a parameter can count.
  constexpr std::uint64_t most_bytes = std::uint64_t{1} << 33;
  const std::uint64_t step = std::min(bytes, most_bytes), word = first / 4;
  const shared::MemoryRange parameters = {static_cast<std::uint32_t>(word),
                                          static_cast<std::uint32_t>(word >> 32),
                                          static_cast<std::uint32_t>(step / 4)};
  const std::size_t items = ceil_divide<std::size_t>(parameters.words, CLEARED_WORDS);
  Launch(device, stage,
         device.programs.get(program_source("kernels/common/clear.cl")).create_kernel("clear"))
      .value(parameters)
      .arg(memory)
      .run_items(items);
  if (step < bytes) clear_together(device, stage, memory, first + step, bytes - step);
}

}  // namespace

void clear_memory(DeviceContext& device, const char* stage, const compute::buffer& memory,
                  std::uint64_t first, std::uint64_t bytes) {
  if (device.traits.clears_in_pieces && bytes >= least_shared_bytes) {
    clear_together(device, stage, memory, first, bytes);
    return;
  }
  const cl_uint zero = 0;
  device.timer.add(
      stage,
      device.queue.enqueue_fill_buffer(memory, &zero, sizeof(zero), static_cast<std::size_t>(first),
                                       static_cast<std::size_t>(bytes)),
      StageTimer::Kind::serial);
}

}  // namespace splotchcl
