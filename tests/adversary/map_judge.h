#pragma once

#include "adversary/judge.h"

namespace splotchcl::adversary {

// What a trial's map is off, over what docs/maps.md says ("How exact").
Measurement measure_map(const Trial& trial, Renderer& renderer);

}  // namespace splotchcl::adversary
