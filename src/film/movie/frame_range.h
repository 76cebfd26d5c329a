#pragma once

#include <string>
#include <vector>

namespace splotchcl {

// The frames that "FIRST:END:STEP" names among those of a film: FIRST, FIRST + STEP, ... before
// END. Each of the three may be left out ("100:", ":200", "::10"); a single number is one
// frame; nothing is all frames. Throws UsageError.
std::vector<int> select_frames(const std::string& text, int frame_count);

// The share of part K of N, given as "K/N", K from 1: neighbouring frames, all parts together
// being all of them. Nothing is all. Throws UsageError.
std::vector<int> select_part(const std::string& text, const std::vector<int>& frames);

}  // namespace splotchcl
