#include "parallel/available_memory.h"

#include <unistd.h>

#include <algorithm>
#include <limits>

#include "system/system.h"

namespace splotchcl {
namespace {

std::uint64_t memory_of_machine() {
  const long pages = ::sysconf(_SC_PHYS_PAGES), page = ::sysconf(_SC_PAGESIZE);
  if (pages <= 0 || page <= 0) return std::numeric_limits<std::uint64_t>::max() / 4;
  return static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page);
}

}  // namespace

std::uint64_t available_memory() {
  return of_system::memory_left().value_or(memory_of_machine());
}

bool is_too_large_to_copy(std::uint64_t bytes) {
  // Less is never looked at: the answer is dear beside it.
  constexpr std::uint64_t small = 16u << 20;
  return bytes > small && bytes > available_memory() / 16;
}

std::size_t held_within_memory(std::uint64_t bytes_of_each) {
  constexpr std::uint64_t part_of_memory = 16, most = 8;
  const std::uint64_t fit =
      available_memory() / part_of_memory / std::max<std::uint64_t>(1, bytes_of_each);
  return static_cast<std::size_t>(std::clamp<std::uint64_t>(fit, 1, most));
}

}  // namespace splotchcl
