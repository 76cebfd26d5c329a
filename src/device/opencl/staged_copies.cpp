#include "device/opencl/staged_copies.h"

#include <cstring>

#include "parallel/for_blocks.h"

namespace splotchcl {
namespace {

// A thread copies a few gigabytes in a second, as long as a slot stays in its caches. A driver
// takes as long to make the slots as to copy several times their size.
constexpr std::size_t slot_bytes = std::size_t{2} << 20;
constexpr std::size_t slot_count = 16;
constexpr std::size_t least_bytes = 4 * slot_bytes;

}  // namespace

// One that this thread alone uses.
class StagedCopies::TakenSlot {
 public:
  explicit TakenSlot(StagedCopies& copies) : copies_(copies), slot_(copies.take_slot()) {}
  TakenSlot(const TakenSlot&) = delete;
  TakenSlot& operator=(const TakenSlot&) = delete;
  ~TakenSlot() { copies_.give_back(slot_); }

  Slot& slot() const { return slot_; }

 private:
  StagedCopies& copies_;
  Slot& slot_;
};

StagedCopies::~StagedCopies() {
  give_up_slots();
}

bool StagedCopies::stages(std::size_t bytes) {
  if (!is_used_ || bytes < least_bytes) return false;
  if (slots_.empty()) make_slots();
  return is_used_;
}

// A system may let a program pin no memory: the driver copies then.
void StagedCopies::make_slots() {
  slots_.resize(slot_count);
  try {
    for (Slot& slot : slots_) {
      slot.memory =
          compute::buffer(context_, slot_bytes, CL_MEM_READ_WRITE | CL_MEM_ALLOC_HOST_PTR);
      slot.mapped =
          queue_.enqueue_map_buffer(slot.memory, CL_MAP_READ | CL_MAP_WRITE, 0, slot_bytes);
      free_.push_back(&slot);
    }
  } catch (const compute::opencl_error&) {
    give_up_slots();
    is_used_ = false;
  }
}

void StagedCopies::give_up_slots() {
  for (const Slot& slot : slots_) {
    if (slot.mapped != nullptr)
      clEnqueueUnmapMemObject(queue_.get(), slot.memory.get(), slot.mapped, 0, nullptr, nullptr);
  }
  if (!slots_.empty()) clFinish(queue_.get());
  free_.clear();
  slots_.clear();
}

StagedCopies::Slot& StagedCopies::take_slot() {
  std::unique_lock<std::mutex> lock(mutex_);
  has_free_.wait(lock, [&] { return !free_.empty(); });
  Slot& slot = *free_.front();
  free_.erase(free_.begin());
  return slot;
}

void StagedCopies::give_back(Slot& slot) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    free_.push_back(&slot);
  }
  has_free_.notify_one();
}

void StagedCopies::by_slots(
    std::size_t bytes,
    const std::function<void(Slot& slot, std::size_t first, std::size_t count)>& copy) {
  for_blocks(bytes, slot_bytes, [&](std::size_t first, std::size_t end) {
    const TakenSlot taken(*this);
    copy(taken.slot(), first, end - first);
  });
}

void StagedCopies::write(const compute::buffer& buffer, const void* from, std::size_t bytes) {
  if (!stages(bytes)) {
    queue_.enqueue_write_buffer(buffer, 0, bytes, from);
    return;
  }
  by_slots(bytes, [&](Slot& slot, std::size_t first, std::size_t count) {
    if (slot.in_use.get() != nullptr) slot.in_use.wait();
    std::memcpy(slot.mapped, static_cast<const char*>(from) + first, count);
    slot.in_use = queue_.enqueue_write_buffer_async(buffer, first, count, slot.mapped);
    queue_.flush();
  });
}

void StagedCopies::read(const compute::buffer& buffer, void* to, std::size_t bytes) {
  if (!stages(bytes)) {
    timer_.add_copy(queue_.enqueue_read_buffer(buffer, 0, bytes, to));
    return;
  }
  by_slots(bytes, [&](Slot& slot, std::size_t first, std::size_t count) {
    slot.in_use = queue_.enqueue_read_buffer_async(buffer, first, count, slot.mapped);
    queue_.flush();
    slot.in_use.wait();
    std::memcpy(static_cast<char*>(to) + first, slot.mapped, count);
  });
}

}  // namespace splotchcl
