#include "parallel/shared_blocks.h"

#include <algorithm>

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

}  // namespace splotchcl
