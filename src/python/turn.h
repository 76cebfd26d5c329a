#pragma once

#include <atomic>
#include <mutex>
#include <thread>

namespace splotchcl::python {

// Threads of Python take turns at an object that is made for one at a time. Locked only while
// Python's own lock is free: who waits here holding it would keep the other from going on.
class Turn {
 public:
  // Throws UsageError for the thread whose turn it is already: a progress callable must not use
  // what calls it.
  void lock();
  void unlock();

 private:
  std::mutex mutex_;
  std::atomic<std::thread::id> owner_ = std::thread::id();
};

}  // namespace splotchcl::python
