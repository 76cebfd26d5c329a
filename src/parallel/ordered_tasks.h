#pragma once

#include <cstddef>
#include <deque>
#include <future>
#include <memory>
#include <utility>

namespace splotchcl {

// The task's result, from a thread of its own; where there are no more threads, the task runs when
// its result is asked for. std::async alone would then run what is left of a task that it had
// already moved into the thread that did not come about.
template <typename Task>
auto in_background(Task task) {
  const auto kept = std::make_shared<Task>(std::move(task));  // const: it is copied, never moved
  return std::async(std::launch::async | std::launch::deferred, [kept] { return (*kept)(); });
}

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
