#include "python/progress.h"

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "splotchcl/error.h"

namespace splotchcl::python {
namespace {

// What threads do without Python's lock, of the only Python that a process has.
struct OngoingWork {
  std::atomic<int> works{0};
  std::atomic<std::thread::id> ender{std::thread::id()};  // that of no thread: nobody ends Python
  static_assert(std::atomic<std::thread::id>::is_always_lock_free);
};

OngoingWork& ongoing() {
  static OngoingWork work;
  return work;
}

bool is_to_end() {
  const std::thread::id ender = ongoing().ender;
  return ender != std::thread::id() && ender != std::this_thread::get_id();
}

}  // namespace

WithoutPython::WithoutPython() {
  ++ongoing().works;
  survive_cut_files();  // compilers of kernels put handlers of their own in its place
  state_ = PyEval_SaveThread();
}

WithoutPython::~WithoutPython() {
  if (is_to_end()) {
    --ongoing().works;
    for (;;)
      ::pause();
  }
  PyEval_RestoreThread(state_);
  --ongoing().works;
}

void end_other_work() {
  ongoing().ender = std::this_thread::get_id();
  PyThreadState* const state = PyEval_SaveThread();
  while (ongoing().works > 0)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  PyEval_RestoreThread(state);
}

void require_whole_files(std::uint64_t cut_before) {
  if (cut_file_count() == cut_before) return;
  throw DataError(std::string(last_cut_file()) +
                  ": became shorter while it was read; wait until it is completely written and try "
                  "again");
}

void forget_other_work() {
  ongoing().works = 0;
}

std::function<void(const std::string&, double)> Progress::function() const {
  return [this](const std::string& what, double fraction) { (*this)(what, fraction); };
}

void Progress::operator()(const std::string& what, double fraction) const {
  if (is_to_end()) throw DataError("Python ends");
  survive_cut_files();
  const py::Lock lock;
  py::require(PyErr_CheckSignals() == 0);
  if (!callable_.is_none()) py::call(callable_, {py::to(what), py::to(fraction)});
}

}  // namespace splotchcl::python
