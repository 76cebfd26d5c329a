#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "parallel/thread_pool.h"

namespace splotchcl::test {
namespace {

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

}  // namespace
}  // namespace splotchcl::test
