#include <dlfcn.h>
#include <pthread.h>

#include <atomic>
#include <cerrno>
#include <thread>

#include "parallel/ordered_tasks.h"
#include "testing.h"

namespace {

std::atomic<bool> has_no_threads{false};

}  // namespace

// In the place of the system's, which finds no thread where a test wants it so.
extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes,
                              void* (*start)(void*), void* argument) noexcept {
  static auto* const original =
      reinterpret_cast<decltype(&pthread_create)>(::dlsym(RTLD_NEXT, "pthread_create"));
  return has_no_threads ? EAGAIN : original(thread, attributes, start, argument);
}

namespace splotchcl {
namespace {

TEST(InBackground, RunsInAThreadOfItsOwn) {
  const std::thread::id here = std::this_thread::get_id();
  EXPECT_NE(in_background([] { return std::this_thread::get_id(); }).get(), here);
}

TEST(InBackground, RunsWhenItIsAskedForWhereThereAreNoThreads) {
  has_no_threads = true;
  const std::thread::id here = std::this_thread::get_id();
  std::future<std::string> result =
      in_background([text = std::string("what the task was given"), here] {
        return std::this_thread::get_id() == here ? text : "another thread";
      });
  has_no_threads = false;
  EXPECT_EQ(result.get(), "what the task was given");
}

}  // namespace
}  // namespace splotchcl
