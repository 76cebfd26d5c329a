#pragma once

#include <functional>
#include <string>

#include "splotchcl/untrusted_file.h"

namespace splotchcl {

// Carries out `task` in a child process, which leaves nothing behind in this one but what becomes
// of it: returns where the task returns, throws the UsageError or DataError that it throws, and
// DataError, beginning with `name`, where the child crashes or needs more than its limits.
void run_in_child(const std::string& name, const std::function<void()>& task,
                  const ChildLimits& limits);

}  // namespace splotchcl
