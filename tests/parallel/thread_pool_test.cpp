// Threads that wait for loops.
#include "parallel/thread_pool.h"

#include <gtest/gtest.h>

#include <atomic>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include "parallel/for_blocks.h"
#include "parallel/threads_of_loop.h"

namespace splotchcl::test {
namespace {

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

}  // namespace
}  // namespace splotchcl::test
