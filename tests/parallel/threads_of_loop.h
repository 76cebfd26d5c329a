#pragma once

#include <algorithm>
#include <cstddef>
#include <mutex>
#include <set>
#include <thread>

#include "parallel/for_blocks.h"

namespace splotchcl::test {

// The threads that so many blocks run on when so many threads are asked for. Blocks end when as
// many threads are at work as there may be.
inline std::set<std::thread::id> threads_of_loop(std::size_t threads, std::size_t blocks) {
  std::mutex mutex;
  std::set<std::thread::id> seen;
  const auto count = [&] {
    const std::lock_guard lock(mutex);
    seen.insert(std::this_thread::get_id());
    return seen.size();
  };
  for_blocks_on(threads, blocks, 1, [&](std::size_t, std::size_t) {
    while (count() < std::min(threads, blocks))
      std::this_thread::yield();
  });
  return seen;
}

}  // namespace splotchcl::test
