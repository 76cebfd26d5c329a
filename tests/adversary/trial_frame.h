#pragma once

#include "adversary/trial.h"
#include "splotchcl/frame.h"

namespace splotchcl::adversary {

// The frame of a trial.
Frame make_frame(const Trial& trial);

// A frame of the same picture that is sooner drawn by the reference: clouds that are the same in
// everything are one cloud with the matter of all of them, and nothing lies outside. In gray
// absorption a cloud's light follows from its own matter, so there they remain.
Frame make_merged_frame(const Trial& trial);

// About how many pixels of splats the two pictures take together.
double cost(const Trial& trial);

}  // namespace splotchcl::adversary
