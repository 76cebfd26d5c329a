#pragma once

#include <functional>

#include "splotchcl/finish.h"
#include "splotchcl/views.h"

// What is promised of a picture counts in units of what it shows as white. Where exposure and tone
// lift light by a factor, errors are lifted with it: the frame is drawn with all light as much
// brighter, by a power of two so that no digit changes, and its light is taken back afterwards.
namespace splotchcl {

// By how much errors of light are larger where they are shown, at most: 2^exposure times the
// steepest slopes of tone, saturation and contrast; at least 1, at most 2^30. Of a contrast below
// 1, which is infinitely steep in the dark, and the balance of white nothing is counted. Exposure
// and white are known.
double display_gain(const FinishSettings& finish, double gamma);

// Draws frames so that errors count `gain` times, or more.
DrawFrame with_errors_counted(const DrawFrame& draw, double gain);

// Asked after frames were drawn: whether they keep their promise where errors count so many times.
// Where they do not, or it is not known, they are drawn again.
using KeepsPromise = std::function<bool(double gain)>;

}  // namespace splotchcl
