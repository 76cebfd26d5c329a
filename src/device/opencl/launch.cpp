#include "device/opencl/launch.h"

#include <algorithm>

namespace splotchcl {
namespace {

std::size_t round_up(std::size_t value, std::size_t step) {
  return (value + step - 1) / step * step;
}

}  // namespace

void Launch::enqueue(std::size_t dimensions, const std::size_t* global, const std::size_t* local) {
  const compute::event event =
      device_.queue.enqueue_nd_range_kernel(kernel_, dimensions, nullptr, global, local);
  if (device_.launches != nullptr) note(dimensions, global, local, event);
  const bool is_one_group = std::equal(global, global + dimensions, local);
  device_.timer.add(stage_, event,
                    is_one_group ? StageTimer::Kind::serial : StageTimer::Kind::parallel);
}

void Launch::note(std::size_t dimensions, const std::size_t* global, const std::size_t* local,
                  const compute::event& event) const {
  LaunchRecord record;
  record.stage = stage_;
  record.kernel = kernel_.name();
  record.items = record.group_items = 1;
  for (std::size_t d = 0; d < dimensions; ++d) {
    record.items *= global[d];
    record.group_items *= local[d];
  }
  record.local_bytes =
      kernel_.get_work_group_info<cl_ulong>(device_.device, CL_KERNEL_LOCAL_MEM_SIZE);
  record.event = event;
  device_.launches->push_back(record);
}

void Launch::run_items(std::size_t items) {
  // On a processor one item is one thread's work.
  if (items == 0) return;
  const std::size_t local = 1;
  enqueue(1, &items, &local);
}

void Launch::run_pieces(std::size_t pieces) {
  if (pieces < 2) return run_items(pieces);
  // PoCL hands out up to 32 items for each thread at once, and half of the last ones.
  constexpr std::size_t enough_items = 1024, most_of_piece = 64;
  run_items(pieces * std::clamp<std::size_t>(enough_items / pieces, 1, most_of_piece));
}

void Launch::run_grid(std::size_t width, std::size_t height, std::size_t depth) {
  if (width == 0 || height == 0 || depth == 0) return;
  const std::size_t local[3] = {64, 1, 1};
  const std::size_t global[3] = {round_up(width, local[0]), height, depth};
  enqueue(3, global, local);
}

void Launch::run_rows(std::size_t rows, std::size_t items) {
  if (rows == 0 || items == 0) return;
  const std::size_t local[2] = {rows, 1};
  const std::size_t global[2] = {rows, items};
  enqueue(2, global, local);
}

void Launch::run_groups(std::size_t groups, std::size_t group_size) {
  if (groups == 0) return;
  const std::size_t global = groups * group_size;
  enqueue(1, &global, &group_size);
}

}  // namespace splotchcl
