#pragma once

#include <optional>

#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// What the check after drawing is likely to ask for where many splats lie upon one another, from
// all particles of a small frame or a sample of others', and where many end, of small frames in
// order: what it asks for is drawn at once, and not a second time. Less than that where the sample
// does not show it; none where nothing more is needed, and in plans that are not checked by an
// estimate. The same in every run, and whatever crop is drawn; `on_all_cores` or by the calling
// thread alone.
std::optional<SplatNeeds> expected_needs(const Frame& frame, const FramePlan& plan,
                                         bool on_all_cores = true);

}  // namespace splotchcl
