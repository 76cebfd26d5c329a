#pragma once

namespace splotchcl {

// Seconds of processor time that the calling thread has taken: waiting takes none, whatever else
// the machine does.
double thread_seconds();

}  // namespace splotchcl
