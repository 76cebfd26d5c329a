#include "device/opencl/shared_work.h"

#include <atomic>
#include <system_error>
#include <thread>

namespace splotchcl {
namespace {

class Threads {
 public:
  // Where there is none to be had, others do the work.
  void start(const std::function<void()>& work) {
    try {
      threads_.emplace_back(work);
    } catch (const std::system_error&) {
    }
  }
  ~Threads() {
    for (std::thread& thread : threads_)
      thread.join();
  }

 private:
  std::vector<std::thread> threads_;
};

}  // namespace

void share_work(std::size_t count, const std::function<void(std::size_t item)>& here,
                const std::vector<std::function<bool(std::size_t item)>>& elsewhere) {
  std::atomic<std::size_t> next{0};
  Threads threads;
  for (const auto& one : elsewhere) {
    threads.start([&next, count, &one] {
      for (std::size_t item = next++; item < count && one(item); item = next++) {
      }
    });
  }
  try {
    for (std::size_t item = next++; item < count; item = next++)
      here(item);
  } catch (...) {
    next = count;
    throw;
  }
}

}  // namespace splotchcl
