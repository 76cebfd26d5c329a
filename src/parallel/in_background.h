#pragma once

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

}  // namespace splotchcl
