#pragma once

#include "splotchcl/frame.h"

namespace splotchcl {

// v, log10(v) or asinh(v). Not finite where the scaling has no value.
double scaled(double value, Scaling scaling);

// The value that is scaled to this.
double unscaled(double value, Scaling scaling);

// The value's place in [0, 1], as ScalarMap says.
double normalized(double value, const ScalarMap& map);

}  // namespace splotchcl
