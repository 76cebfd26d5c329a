#include "python/turn.h"

#include "splotchcl/error.h"

namespace splotchcl::python {

void Turn::lock() {
  if (owner_ == std::this_thread::get_id()) {
    throw UsageError(
        "a progress callable uses the renderer or the particles that call it, expected others; do "
        "it when the picture is drawn");
  }
  mutex_.lock();
  owner_ = std::this_thread::get_id();
}

void Turn::unlock() {
  owner_ = std::thread::id();
  mutex_.unlock();
}

}  // namespace splotchcl::python
