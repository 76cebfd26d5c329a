#pragma once

#include <cstdint>

namespace splotchcl::bench {

// Bytes a second that this machine moves right now, all threads together, walking through arrays
// of `bytes` in all, part by part: the best of reading them, of scaling one into another and of
// adding two into a third, and of several runs of each. Arrays far larger than the caches show
// what memory gives; smaller ones, what the caches do that they fit in.
//
// A byte that is written counts twice: its line of the cache is read first, as ordinary stores do.
// Whoever divides bytes by this has to count them so, too (floors.h).
double measure_bandwidth(std::uint64_t bytes, int threads);

}  // namespace splotchcl::bench
