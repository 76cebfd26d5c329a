#pragma once

#include <functional>
#include <string>

#include "splotchcl/communicator.h"

// Where one rank fails, all end, and one of them says why.
namespace splotchcl {

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
