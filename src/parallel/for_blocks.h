#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace splotchcl {

// The blocks of one call of for_blocks(), which any number of threads take by turns.
class SharedBlocks {
 public:
  SharedBlocks(std::size_t count, std::size_t block_size,
               const std::function<void(std::size_t, std::size_t)>& work)
      : count_(count), block_size_(block_size), work_(work) {}

  bool has_blocks() const { return next_.load() < count_; }
  // Until there are none. `progress`, where it is one, is told which part is done.
  void take_blocks(const std::function<void(double)>& progress = {});
  // The first exception of any thread, once all have ended.
  void throw_error() const;

 private:
  const std::size_t count_, block_size_;
  const std::function<void(std::size_t, std::size_t)>& work_;
  std::atomic<std::size_t> next_{0}, done_{0};
  std::mutex of_error_;
  std::exception_ptr error_;
};

// Threads that wait for loops: to start one takes longer than most loops of a frame, of which there
// are dozens. They are started when they are wanted first, and end with the pool.
class ThreadPool {
 public:
  ThreadPool() = default;
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;
  ~ThreadPool();

  // Runs the loop on so many threads at most, the calling one among them, which is told of
  // progress. Loops that this one's work calls for_blocks() for run on these threads, too.
  void run(SharedBlocks& loop, std::size_t threads, const std::function<void(double)>& progress);

  // The pool of the loops that this thread calls for_blocks() for; null: each starts its own.
  static ThreadPool* of_this_thread();

  // As long as it lives, the calling thread's loops run on the pool.
  class Scope {
   public:
    explicit Scope(ThreadPool& pool);
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;
    ~Scope();

   private:
    ThreadPool* const before_;
  };

 private:
  // A loop that others may join.
  struct OpenLoop {
    SharedBlocks& loop;
    std::size_t room = 0, helpers = 0;  // threads that may join, and those that have
  };
  void start_threads(std::size_t count);
  void wait_for_loops();
  OpenLoop* loop_with_room() const;

  std::mutex mutex_;  // of all that follows
  std::condition_variable opened_, left_;
  std::vector<OpenLoop*> open_;
  std::vector<std::thread> threads_;
  bool ends_ = false;
};

// Seconds of processor time that the calling thread has taken: waiting takes none, whatever else
// the machine does.
double thread_seconds();

// Calls work(first, last) for the blocks of [0, count) on all cores, in any order: on threads of
// the calling thread's ThreadPool, or new ones where it has none. `progress` is called now and then
// from the calling thread with the fraction done. The first exception is thrown again when all
// threads have ended.
void for_blocks(std::size_t count, std::size_t block_size,
                const std::function<void(std::size_t, std::size_t)>& work,
                const std::function<void(double)>& progress = {});
// For whoever is given a loop to run by.
inline void run_on_all_cores(std::size_t count, std::size_t block_size,
                             const std::function<void(std::size_t, std::size_t)>& work) {
  for_blocks(count, block_size, work);
}

// The same on so many threads, the calling one among them, or as many as there are blocks.
void for_blocks_on(std::size_t threads, std::size_t count, std::size_t block_size,
                   const std::function<void(std::size_t, std::size_t)>& work,
                   const std::function<void(double)>& progress = {});

}  // namespace splotchcl
