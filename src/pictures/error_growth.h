#pragma once

#include "splotchcl/finish.h"
#include "splotchcl/image.h"

namespace splotchcl {

// By how much relative errors of light grow where it is finished: by exposure, balance
// of white, tone, highlights, saturation and contrast. A channel errs by a part of its light or of
// 1 / `gain`, whichever is more, and what is shown counts in units of white or of its pixel's
// brightest channel. Found by finishing colors of all kinds with errors of all signs. A contrast
// below 1, which is infinitely steep in the dark, counts as 1. Exposure and white are known.
double error_growth(FinishSettings finish, double gamma, double gain);

// The same of a picture's own colors, of which some hundred thousand are finished.
double error_growth(const Image& light, FinishSettings finish, double gamma, double gain);

}  // namespace splotchcl
