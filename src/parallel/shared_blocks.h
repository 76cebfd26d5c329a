#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>

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

}  // namespace splotchcl
