#pragma once

// The structures that host and kernels share, in a namespace of their own.
namespace splotchcl::kernel {
#include "parameters.h"
}
