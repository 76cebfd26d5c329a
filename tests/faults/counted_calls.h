#pragma once

#include <array>
#include <atomic>

namespace splotchcl::test {

// Calls of the system that can be made to fail. What they stand for is in failing_calls.cpp.
constexpr std::array<const char*, 15> counted_calls = {
    "open",   "read",     "write", "short_write", "fsync", "close",  "rename", "link",
    "unlink", "truncate", "mkdir", "mmap",        "fork",  "thread", "malloc"};

// How often each was called: a file in memory, which outlives the program however it ends.
using CallCounts = std::array<std::atomic<long>, counted_calls.size()>;

}  // namespace splotchcl::test
