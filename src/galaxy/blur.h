#pragma once

#include <vector>

namespace splotchcl {

// The mean over a Gaussian of this standard deviation in pixels around each of a picture's values,
// rows from the top; what lies outside of the picture does not count.
std::vector<double> blurred(const std::vector<double>& values, int width, double deviation);

}  // namespace splotchcl
