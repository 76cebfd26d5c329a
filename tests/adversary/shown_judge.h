#pragma once

#include "adversary/judge.h"

namespace splotchcl::adversary {

// What a trial's finished picture is off, against the reference's, finished alike: in units of what
// is shown as white (docs/accuracy.md).
Measurement measure_shown(const Trial& trial, Renderer& renderer);

}  // namespace splotchcl::adversary
