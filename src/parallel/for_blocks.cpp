#include "parallel/for_blocks.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>
#include <vector>

namespace splotchcl {

void for_blocks(std::size_t count, std::size_t block_size,
                const std::function<void(std::size_t, std::size_t)>& work,
                const std::function<void(double)>& progress) {
  std::atomic<std::size_t> next{0};
  std::atomic<std::size_t> done{0};
  const std::size_t threads = std::min<std::size_t>(
      std::max(1U, std::thread::hardware_concurrency()), (count + block_size - 1) / block_size);
  std::vector<std::exception_ptr> errors(std::max<std::size_t>(threads, 1));
  const auto run = [&](std::size_t thread) {
    try {
      for (std::size_t first = next.fetch_add(block_size); first < count;
           first = next.fetch_add(block_size)) {
        const std::size_t last = std::min(first + block_size, count);
        work(first, last);
        done += last - first;
        if (thread == 0 && progress) {
          progress(static_cast<double>(done.load()) / static_cast<double>(count));
        }
      }
    } catch (...) {
      errors[thread] = std::current_exception();
      next = count;  // the others need not go on
    }
  };
  std::vector<std::thread> others;
  others.reserve(threads);
  try {
    for (std::size_t thread = 1; thread < threads; ++thread)
      others.emplace_back(run, thread);
  } catch (...) {
    // A limit on threads, or no memory for another: fewer do the same.
  }
  run(0);
  for (std::thread& other : others)
    other.join();
  for (const std::exception_ptr& error : errors) {
    if (error) std::rethrow_exception(error);
  }
  if (progress) progress(1);
}

}  // namespace splotchcl
