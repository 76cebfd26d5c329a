#pragma once

#include "adversary/judge.h"
#include "adversary/search.h"

namespace splotchcl::adversary {

// The same failure in a scene that is easier to read: fewer groups and copies, defaults, numbers
// of one or two digits, as long as most of the error stays.
Finding simplified(const Finding& finding, Judge& judge);

}  // namespace splotchcl::adversary
