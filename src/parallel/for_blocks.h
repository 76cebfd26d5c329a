#pragma once

#include <cstddef>
#include <functional>

namespace splotchcl {

// Calls work(first, last) for the blocks of [0, count) on all cores, in any order: on threads of
// the calling thread's pool (thread_pool.h), or new ones where it has none. `progress` is called
// now and then from the calling thread with the fraction done. The first exception is thrown again
// when all threads have ended.
void for_blocks(std::size_t count, std::size_t block_size,
                const std::function<void(std::size_t, std::size_t)>& work,
                const std::function<void(double)>& progress = {});

// The same on so many threads, the calling one among them, or as many as there are blocks.
void for_blocks_on(std::size_t threads, std::size_t count, std::size_t block_size,
                   const std::function<void(std::size_t, std::size_t)>& work,
                   const std::function<void(double)>& progress = {});

}  // namespace splotchcl
