#include "parallel/for_blocks.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <exception>
#include <thread>
#include <vector>

namespace splotchcl {
namespace {

using Work = std::function<void(std::size_t, std::size_t)>;
using Progress = std::function<void(double)>;

// One call of for_blocks().
class Loop {
 public:
  Loop(std::size_t count, std::size_t block_size, std::size_t threads, const Work& work,
       const Progress& progress)
      : count_(count),
        block_size_(block_size),
        work_(work),
        progress_(progress),
        errors_(std::max<std::size_t>(threads, 1)) {}

  // A thread starts two others, and each of these two more: to start dozens one after the other
  // would take as long as many of these loops.
  void run(std::size_t thread) {
    std::array<std::thread, 2> others;
    try {
      for (std::size_t k = 0; k < others.size(); ++k) {
        const std::size_t other = 2 * thread + 1 + k;
        if (other < errors_.size()) others[k] = std::thread([this, other] { run(other); });
      }
    } catch (...) {
      // A limit on threads, or no memory for another: fewer do the same.
    }
    take_blocks(thread);
    for (std::thread& other : others) {
      if (other.joinable()) other.join();
    }
  }

  void throw_first_error() const {
    for (const std::exception_ptr& error : errors_) {
      if (error) std::rethrow_exception(error);
    }
  }

 private:
  void take_blocks(std::size_t thread) {
    try {
      for (std::size_t first = next_.fetch_add(block_size_); first < count_;
           first = next_.fetch_add(block_size_)) {
        const std::size_t last = std::min(first + block_size_, count_);
        work_(first, last);
        done_ += last - first;
        if (thread == 0 && progress_)
          progress_(static_cast<double>(done_.load()) / static_cast<double>(count_));
      }
    } catch (...) {
      errors_[thread] = std::current_exception();
      next_ = count_;  // the others need not go on
    }
  }

  const std::size_t count_, block_size_;
  const Work& work_;
  const Progress& progress_;
  std::atomic<std::size_t> next_{0}, done_{0};
  std::vector<std::exception_ptr> errors_;  // of each thread
};

}  // namespace

void for_blocks(std::size_t count, std::size_t block_size, const Work& work,
                const Progress& progress) {
  for_blocks_on(std::thread::hardware_concurrency(), count, block_size, work, progress);
}

void for_blocks_on(std::size_t threads, std::size_t count, std::size_t block_size, const Work& work,
                   const Progress& progress) {
  const std::size_t blocks = (count + block_size - 1) / block_size;
  Loop loop(count, block_size, std::min(threads, blocks), work, progress);
  loop.run(0);
  loop.throw_first_error();
  if (progress) progress(1);
}

}  // namespace splotchcl
