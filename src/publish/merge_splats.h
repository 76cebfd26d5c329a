#pragma once

#include <cstddef>
#include <vector>

#include "publish/light_splats.h"

namespace splotchcl {

// At most so many splats in place of all. Each of them has the light of those that it stands for,
// their center of light and the second moment of their light, taken round; what they absorb counts
// a tenth as much. Splats that are split
// are those where that loses most of what is shown, by an estimate: the square root of their light,
// as displays show light nearly, times how much of the width squared is distances between members
// and differences of their widths. The same for any number of threads.
std::vector<LightSplat> merge_splats(std::vector<LightSplat> splats, std::size_t most);

}  // namespace splotchcl
