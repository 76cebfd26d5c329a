#pragma once

#include <functional>

#include "splotchcl/finish.h"
#include "splotchcl/views.h"

// What is promised of a picture counts in units of what it shows as white. Where exposure and tone
// lift light by a factor, errors are lifted with it: the frame is drawn with all light as much
// brighter, by a power of two so that no digit changes, and its light is taken back afterwards.
namespace splotchcl {

// By how much errors of light are larger where they are shown: those of dark light by both factors,
// those of bright light, which are parts of it, by the second.
struct DisplayGain {
  double of_light = 1;   // 2^exposure times the steepest slope of tone; at least 1, at most 2^30
  double of_errors = 1;  // error_growth()
  double total() const { return of_light * of_errors; }
};

// Exposure and white are known.
DisplayGain display_gain(const FinishSettings& finish, double gamma);

// The same for the colors of a picture, without lower limits: below 1 where light is shown darker
// than it is drawn, so that more of what it errs by serves.
DisplayGain display_gain_of_shown(const Image& light, const FinishSettings& finish, double gamma);

// Draws frames so that errors count as often.
DrawFrame with_errors_counted(const DrawFrame& draw, const DisplayGain& gain);

// Whether a drawing whose errors are estimated to be such a part of its promise keeps it where they
// count `gain` times. Estimates far below a promise are coarse: they may be off a few times.
bool keeps_promise_at(double gain, double estimated_error_of_promise);

// Asked after frames were drawn: whether they keep their promise where errors count so many times.
// Where they do not, or it is not known, they are drawn again.
using KeepsPromise = std::function<bool(double gain)>;

// Where errors that a display cannot show save time: of merged particles as many are drawn as what
// may be erred by needs. Particles take as long.
struct LooseDrawing {
  std::function<bool(const Frame&)> serves;
  DrawFrame draw_roughly;  // at little cost, for the light that exposure is found from
};

}  // namespace splotchcl
