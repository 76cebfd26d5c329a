#include <unistd.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>

#include "parallel/available_memory.h"
#include "parallel/for_blocks.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// The threads that so many blocks run on when so many threads are asked for. Blocks end when as
// many threads are at work as there may be.
std::set<std::thread::id> threads_of_loop(std::size_t threads, std::size_t blocks) {
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

// Threads that wait for loops.

TEST(ThreadPool, RunsLoopsOnTheSameThreads) {
  ThreadPool pool;
  const ThreadPool::Scope scope(pool);
  const std::set<std::thread::id> first = threads_of_loop(5, 5);
  EXPECT_EQ(first.size(), 5u);
  for (int i = 0; i < 20; ++i)
    EXPECT_EQ(threads_of_loop(5, 5), first);
}

TEST(ThreadPool, HasMoreThreadsWhereALoopWantsThem) {
  ThreadPool pool;
  const ThreadPool::Scope scope(pool);
  EXPECT_EQ(threads_of_loop(2, 2).size(), 2u);
  EXPECT_EQ(threads_of_loop(9, 9).size(), 9u);
}

TEST(ThreadPool, TakesEverythingOnceInLoopsWithinLoops) {
  ThreadPool pool;
  const ThreadPool::Scope scope(pool);
  for (int round = 0; round < 50; ++round) {
    std::vector<std::atomic<int>> taken(12 * 100);
    for_blocks_on(6, 12, 1, [&](std::size_t outer, std::size_t) {
      for_blocks_on(6, 100, 7, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
          ++taken[outer * 100 + i];
      });
    });
    EXPECT_EQ(std::vector<int>(taken.begin(), taken.end()), std::vector<int>(1200, 1));
  }
}

TEST(ThreadPool, RunsAnotherLoopAfterOneThatThrew) {
  ThreadPool pool;
  const ThreadPool::Scope scope(pool);
  const auto loop = [] {
    for_blocks_on(4, 100, 1, [](std::size_t first, std::size_t) {
      if (first == 50) throw std::runtime_error("found");
    });
  };
  EXPECT_THROW(loop(), std::runtime_error);
  EXPECT_EQ(threads_of_loop(4, 4).size(), 4u);
}

TEST(ThreadPool, IsOfItsScopeAlone) {
  ThreadPool outer, inner;
  EXPECT_EQ(ThreadPool::of_this_thread(), nullptr);
  {
    const ThreadPool::Scope of_outer(outer);
    {
      const ThreadPool::Scope of_inner(inner);
      EXPECT_EQ(ThreadPool::of_this_thread(), &inner);
    }
    EXPECT_EQ(ThreadPool::of_this_thread(), &outer);
    std::thread([] { EXPECT_EQ(ThreadPool::of_this_thread(), nullptr); }).join();
  }
  EXPECT_EQ(ThreadPool::of_this_thread(), nullptr);
}

// Loops that all cores share.

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

TEST(ThreadSeconds, GrowWithWork) {
  const double before = thread_seconds();
  volatile double sum = 0;
  while (thread_seconds() < before + 0.01)
    sum = sum + 1;
  EXPECT_GT(sum, 0);
}

TEST(ThreadSeconds, DoNotGrowWhileTheThreadWaits) {
  const double before = thread_seconds();
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_LT(thread_seconds() - before, 0.1);
}

TEST(ThreadSeconds, AreThoseOfTheThreadAlone) {
  const double before = thread_seconds();
  std::thread([] {
    const double start = thread_seconds();
    while (thread_seconds() < start + 0.2) {
    }
  }).join();
  EXPECT_LT(thread_seconds() - before, 0.1);
}

TEST(AvailableMemory, IsSomeOfWhatTheMachineHas) {
  const std::uint64_t all = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
                            static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  EXPECT_GT(available_memory(), 0u);
  EXPECT_LE(available_memory(), all);
}

TEST(AvailableMemory, HasRoomForCopiesOfSmallColumnsAlone) {
  EXPECT_FALSE(is_too_large_to_copy(0));
  EXPECT_FALSE(is_too_large_to_copy(16u << 20));
  EXPECT_TRUE(is_too_large_to_copy(available_memory()));
}

}  // namespace
}  // namespace splotchcl::test
