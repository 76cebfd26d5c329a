#pragma once

#include <optional>
#include <vector>

#include "scene/plan/cloud_sample.h"
#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// Whether what a drawing by this plan needs can be expected from a sample: not where the check
// finds bounds, of ellipses, and of sums that err by nothing that a sample shows.
bool can_be_expected(const FramePlan& plan);

// What the check after drawing is likely to ask for where many splats lie upon one another, from
// all particles of a small frame or a sample of others': what it asks for is drawn at once, and not
// a second time. Less than that where the sample does not show it; none where nothing more is
// needed. The same in every run, and whatever crop is drawn. Of plans of which it can be expected.
std::optional<SplatNeeds> expected_needs(const std::vector<SampledCloud>& clouds,
                                         const Frame& frame, const FramePlan& plan,
                                         const BlockLoop& loop = one_after_the_other);

}  // namespace splotchcl
