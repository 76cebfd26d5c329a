#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <type_traits>

#include "common/guards.h"
#include "python/interface/casts.h"

namespace splotchcl::python {

// While it lives, other threads of Python go on. Where Python ends meanwhile, its thread never
// comes back: Python's end would go through frames of C++ and abort the program, and what the
// thread uses would be taken from it.
class WithoutPython {
 public:
  WithoutPython();
  ~WithoutPython();
  WithoutPython(const WithoutPython&) = delete;
  WithoutPython& operator=(const WithoutPython&) = delete;

 private:
  PyThreadState* state_;
};

// Python is about to end: whatever other threads do is ended at its next progress, and waited for.
void end_other_work();
// Of a process that was forked: it has only the thread that forked.
void forget_other_work();

// Throws DataError where a mapped file has become shorter since there were so many such files.
void require_whole_files(std::uint64_t cut_before);

// Runs work while other threads of Python go on.
template <typename Work>
auto without_python(Work&& work) {
  const WithoutPython free;
  const std::uint64_t cut_before = cut_file_count();
  if constexpr (std::is_void_v<decltype(work())>) {
    work();
    require_whole_files(cut_before);
  } else {
    auto result = work();
    require_whole_files(cut_before);
    return result;
  }
}

// Tells a callable of Python, or None, what is being done and the fraction done. What the callable
// raises, and an interruption from the keyboard, end the work.
class Progress {
 public:
  explicit Progress(py::Object callable) : callable_(std::move(callable)) {}
  // To be called without Python's lock. Must not outlive this.
  std::function<void(const std::string& what, double fraction)> function() const;
  void operator()(const std::string& what, double fraction) const;

 private:
  py::Object callable_;
};

}  // namespace splotchcl::python
