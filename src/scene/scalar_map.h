#pragma once

#include <optional>

#include "splotchcl/frame.h"

namespace splotchcl {

// v, log10(v) or asinh(v). Not finite where the scaling has no value.
double scaled(double value, Scaling scaling);

// The value that is scaled to this.
double unscaled(double value, Scaling scaling);

// The value that a logarithm or asinh maps to 0, where single precision can tell how far others are
// from it before it takes their logarithm or asinh: then ranges that are far narrower than their
// values keep their digits (docs/dev/accuracy.md, "Colors and intensities"). None of linear fields,
// and where a float could not hold what comes between.
std::optional<double> least_before_scaling(const ScalarMap& map);

// The value's place in [0, 1], as ScalarMap says.
double normalized(double value, const ScalarMap& map);

}  // namespace splotchcl
