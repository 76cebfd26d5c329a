// Loops that all cores share.
#include "parallel/for_blocks.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

#include "parallel/threads_of_loop.h"

namespace splotchcl::test {
namespace {

// How often each of so many things was taken, by any of so many threads.
std::vector<int> times_taken(std::size_t threads, std::size_t count, std::size_t block_size) {
  std::vector<std::atomic<int>> taken(count);
  for_blocks_on(threads, count, block_size, [&](std::size_t first, std::size_t last) {
    EXPECT_LE(last - first, block_size);
    for (std::size_t i = first; i < last; ++i)
      ++taken[i];
  });
  return {taken.begin(), taken.end()};
}

TEST(ForBlocks, TakesEverythingOnceOnAnyNumberOfThreads) {
  for (const std::size_t threads : {0, 1, 2, 3, 4, 7, 8, 64})
    EXPECT_EQ(times_taken(threads, 1000, 3), std::vector<int>(1000, 1)) << threads << " threads";
}

TEST(ForBlocks, TakesNothingOfNothing) {
  EXPECT_TRUE(times_taken(4, 0, 8).empty());
}

TEST(ForBlocks, HasAsManyThreadsAsItIsToldOrAsThereAreBlocks) {
  EXPECT_EQ(threads_of_loop(1, 4).size(), 1u);
  EXPECT_EQ(threads_of_loop(16, 4).size(), 4u);
  EXPECT_EQ(threads_of_loop(5, 40).size(), 5u);
  EXPECT_EQ(threads_of_loop(16, 40).size(), 16u);
}

TEST(ForBlocks, ThrowsWhatAnyThreadThrew) {
  for (const std::size_t bad : {0, 17, 99}) {
    const auto loop = [bad] {
      for_blocks_on(8, 100, 1, [bad](std::size_t first, std::size_t) {
        if (first == bad) throw std::runtime_error("found");
      });
    };
    EXPECT_THROW(loop(), std::runtime_error) << "thrown at " << bad;
  }
}

TEST(ForBlocks, TellsTheCallingThreadHowFarItIs) {
  const std::thread::id caller = std::this_thread::get_id();
  double last = 0;
  for_blocks_on(
      4, 100, 1, [](std::size_t, std::size_t) {},
      [&](double done) {
        EXPECT_EQ(std::this_thread::get_id(), caller);
        EXPECT_GE(done, last);
        last = done;
      });
  EXPECT_EQ(last, 1);
}

}  // namespace
}  // namespace splotchcl::test
