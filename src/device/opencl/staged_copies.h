#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <vector>

#include "device/opencl/device_traits.h"
#include "device/opencl/opencl.h"
#include "device/opencl/stage_timer.h"

namespace splotchcl {

// Large copies between a program's memory and that of a GPU. Its driver copies what it cannot reach
// by itself on one thread, by way of memory of its own that the GPU can; here all cores do. Small
// copies, and those of devices in the host's memory, are left to the driver.
class StagedCopies {
 public:
  // `timer` is told of what the driver's one thread reads.
  StagedCopies(const compute::context& context, const compute::command_queue& queue,
               StageTimer& timer, const DeviceTraits& traits)
      : context_(context),
        queue_(queue),
        timer_(timer),
        is_used_(traits.is_gpu && !traits.shares_host_memory) {}
  StagedCopies(const StagedCopies&) = delete;
  StagedCopies& operator=(const StagedCopies&) = delete;
  ~StagedCopies();

  // The caller's memory may change once this returns; commands that follow see what it held.
  void write(const compute::buffer& buffer, const void* from, std::size_t bytes);
  // Waits for the commands before.
  void read(const compute::buffer& buffer, void* to, std::size_t bytes);

 private:
  // Memory that the GPU reaches, and the command that may still read it.
  struct Slot {
    compute::buffer memory;
    void* mapped = nullptr;
    compute::event in_use;
  };

  class TakenSlot;

  // Whether so many are copied by way of slots, which there are then.
  bool stages(std::size_t bytes);
  void make_slots();
  void give_up_slots();
  // All parts of so many bytes, each with a slot of its own, on all cores.
  void by_slots(std::size_t bytes,
                const std::function<void(Slot& slot, std::size_t first, std::size_t count)>& copy);
  Slot& take_slot();
  void give_back(Slot& slot);

  compute::context context_;
  compute::command_queue queue_;
  StageTimer& timer_;
  bool is_used_;
  std::vector<Slot> slots_;
  std::vector<Slot*> free_;
  std::mutex mutex_;
  std::condition_variable has_free_;
};

}  // namespace splotchcl
