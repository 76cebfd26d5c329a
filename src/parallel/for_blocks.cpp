#include "parallel/for_blocks.h"

#include <algorithm>
#include <array>
#include <ctime>
#include <thread>

namespace splotchcl {

void SharedBlocks::take_blocks(const std::function<void(double)>& progress) {
  try {
    for (std::size_t first = next_.fetch_add(block_size_); first < count_;
         first = next_.fetch_add(block_size_)) {
      const std::size_t last = std::min(first + block_size_, count_);
      work_(first, last);
      done_ += last - first;
      if (progress) progress(static_cast<double>(done_.load()) / static_cast<double>(count_));
    }
  } catch (...) {
    const std::lock_guard lock(of_error_);
    if (!error_) error_ = std::current_exception();
    next_ = count_;  // the others need not go on
  }
}

void SharedBlocks::throw_error() const {
  if (error_) std::rethrow_exception(error_);
}

namespace {

thread_local ThreadPool* pool_of_thread = nullptr;

}  // namespace

ThreadPool* ThreadPool::of_this_thread() {
  return pool_of_thread;
}

ThreadPool::Scope::Scope(ThreadPool& pool) : before_(pool_of_thread) {
  pool_of_thread = &pool;
}

ThreadPool::Scope::~Scope() {
  pool_of_thread = before_;
}

ThreadPool::~ThreadPool() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  opened_.notify_all();
  for (std::thread& thread : threads_)
    thread.join();
}

void ThreadPool::run(SharedBlocks& loop, std::size_t threads,
                     const std::function<void(double)>& progress) {
  const std::size_t others = threads > 0 ? threads - 1 : 0;
  OpenLoop open = {loop, others, 0};
  {
    const std::lock_guard lock(mutex_);
    start_threads(others);
    open_.push_back(&open);
  }
  for (std::size_t k = 0; k < others; ++k)
    opened_.notify_one();
  loop.take_blocks(progress);
  std::unique_lock lock(mutex_);
  open_.erase(std::find(open_.begin(), open_.end(), &open));
  left_.wait(lock, [&open] { return open.helpers == 0; });
}

// So many in all.
void ThreadPool::start_threads(std::size_t count) {
  try {
    while (threads_.size() < count)
      threads_.emplace_back([this] { wait_for_loops(); });
  } catch (...) {
    // A limit on threads, or no memory for another: fewer do the same.
  }
}

// Innermost loops first: others wait for these.
ThreadPool::OpenLoop* ThreadPool::loop_with_room() const {
  const auto found = std::find_if(open_.rbegin(), open_.rend(), [](const OpenLoop* open) {
    return open->room > 0 && open->loop.has_blocks();
  });
  return found != open_.rend() ? *found : nullptr;
}

void ThreadPool::wait_for_loops() {
  const Scope scope(*this);
  std::unique_lock lock(mutex_);
  for (;;) {
    OpenLoop* open = nullptr;
    opened_.wait(lock, [&] { return ends_ || (open = loop_with_room()) != nullptr; });
    if (ends_) return;
    --open->room;
    ++open->helpers;
    lock.unlock();
    open->loop.take_blocks();
    lock.lock();
    if (--open->helpers == 0) left_.notify_all();
  }
}

double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

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
