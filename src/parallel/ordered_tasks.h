#pragma once

#include <cstddef>
#include <deque>
#include <future>
#include <utility>

#include "parallel/in_background.h"

namespace splotchcl {

// Tasks in the background, whose results are taken in the order in which they were begun. Waits for
// all of them when it ends.
template <class Result>
class OrderedTasks {
 public:
  std::size_t size() const { return begun_.size(); }

  template <class Task>
  void begin(Task task) {
    begun_.push_back(in_background(std::move(task)));
  }

  // That of the task that was begun first, of which there must be one: waits for it. Throws what it
  // has thrown.
  Result take() {
    std::future<Result> first = std::move(begun_.front());
    begun_.pop_front();
    return first.get();
  }

 private:
  std::deque<std::future<Result>> begun_;
};

}  // namespace splotchcl
