#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

#include "splotchcl/communicator.h"

// Values and texts among ranks.
namespace splotchcl {

// One of each rank, by rank; known to all.
std::vector<std::uint64_t> gather_values(Communicator& ranks, std::uint64_t own);
std::vector<std::string> gather_texts(Communicator& ranks, const std::string& own);
// What all ranks have, one after the other.
std::vector<std::uint64_t> gather_lists(Communicator& ranks, const std::vector<std::uint64_t>& own);
std::uint64_t smallest_of(Communicator& ranks, std::uint64_t own);

// Each of these becomes the sum of all ranks'.
void add_up(Communicator& ranks, const std::vector<std::uint64_t*>& counts);

// Rank r has set values [begins[r], begins[r + 1]), and all have all afterwards.
void join_stretches(Communicator& ranks, std::vector<float>& values,
                    const std::vector<std::size_t>& begins);

// The root's, at every rank; of any length.
template <class T>
void broadcast_values(Communicator& ranks, std::vector<T>& values, int root = 0) {
  static_assert(std::is_trivially_copyable_v<T>);
  std::uint64_t count = values.size();
  ranks.broadcast(&count, sizeof(count), root);
  values.resize(static_cast<std::size_t>(count));
  if (count > 0) ranks.broadcast(values.data(), values.size() * sizeof(T), root);
}

template <class T>
void broadcast_value(Communicator& ranks, T& value, int root = 0) {
  static_assert(std::is_trivially_copyable_v<T>);
  ranks.broadcast(&value, sizeof(T), root);
}

// Where one rank fails, all end, and one of them says why.

// Collective: does the work, and waits until all ranks have done theirs. Where it throws an Error
// on some, it is thrown on the first of them, which names itself unless all failed alike, and
// FailedElsewhere on all others. What it throws that ranks have agreed upon is thrown as it is.
// `ranks` may be null: one process.
void agree(Communicator* ranks, const std::function<void()>& work);

// Collective, before each step of such work that all ranks make together: where one has failed, the
// work of the others ends here.
void wait_for_all(Communicator& ranks);

// Both halves of it: what the work has thrown, empty where it has not failed; and, collective, what
// follows from what all have told.
std::string told(const std::function<void()>& work);
void settle(Communicator& ranks, const std::string& own);

// Throws DeviceError on all ranks where they have not the same text; `what` names it.
void require_same(Communicator& ranks, const std::string& what, const std::string& own,
                  const std::string& advice);

}  // namespace splotchcl
