#include "parallel/for_blocks.h"

#include <algorithm>
#include <array>
#include <thread>

#include "parallel/thread_pool.h"

namespace splotchcl {
namespace {

// On threads `number` to `threads` - 1 of a tree: each starts two others, and these two more. To
// start dozens one after the other would take as long as many of these loops.
void run_on_new_threads(SharedBlocks& loop, std::size_t number, std::size_t threads,
                        const std::function<void(double)>& progress) {
  std::array<std::thread, 2> others;
  try {
    for (std::size_t k = 0; k < others.size(); ++k) {
      const std::size_t other = 2 * number + 1 + k;
      if (other >= threads) break;
      others[k] =
          std::thread([&loop, other, threads] { run_on_new_threads(loop, other, threads, {}); });
    }
  } catch (...) {
    // A limit on threads, or no memory for another: fewer do the same.
  }
  loop.take_blocks(progress);
  for (std::thread& other : others) {
    if (other.joinable()) other.join();
  }
}

}  // namespace

void for_blocks(std::size_t count, std::size_t block_size,
                const std::function<void(std::size_t, std::size_t)>& work,
                const std::function<void(double)>& progress) {
  for_blocks_on(std::thread::hardware_concurrency(), count, block_size, work, progress);
}

void for_blocks_on(std::size_t threads, std::size_t count, std::size_t block_size,
                   const std::function<void(std::size_t, std::size_t)>& work,
                   const std::function<void(double)>& progress) {
  SharedBlocks loop(count, block_size, work);
  const std::size_t of_loop = std::min(threads, (count + block_size - 1) / block_size);
  ThreadPool* const pool = ThreadPool::of_this_thread();
  if (pool != nullptr && of_loop > 1)
    pool->run(loop, of_loop, progress);
  else
    run_on_new_threads(loop, 0, of_loop, progress);
  loop.throw_error();
  if (progress) progress(1);
}

}  // namespace splotchcl
