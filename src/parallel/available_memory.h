#pragma once

#include <cstddef>
#include <cstdint>

namespace splotchcl {

// Bytes that this process may still take without others being swapped out: what the system says is
// available, within the limit of a control group where it lies in one; what the machine has where
// neither is known.
std::uint64_t available_memory();

// Whether so many bytes are more than one of the arrays that a snapshot is read into should take:
// a sixteenth of what is available.
bool is_too_large_to_copy(std::uint64_t bytes);

// How many things of so many bytes may be held at a time where one would do: as many as a sixteenth
// of what is available holds, from 1 to 8.
std::size_t held_within_memory(std::uint64_t bytes_of_each);

}  // namespace splotchcl
