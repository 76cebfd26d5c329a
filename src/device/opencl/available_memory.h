#pragma once

#include <cstdint>

namespace splotchcl {

// Bytes that this process may still take without others being swapped out: what the system says is
// available, within the limit of a control group where it lies in one; what the machine has where
// neither is known.
std::uint64_t available_memory();

}  // namespace splotchcl
