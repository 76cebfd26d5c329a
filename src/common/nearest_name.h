#pragma once

#include <optional>
#include <string>
#include <vector>

namespace splotchcl {

// The candidate that `name` is most likely a misspelling of, or none when nothing is
// near: more than a third of its letters would have to change. Case counts little.
std::optional<std::string> nearest_name(const std::string& name,
                                        const std::vector<std::string>& candidates);

// "; did you mean x?", or nothing.
std::string did_you_mean(const std::optional<std::string>& name);

}  // namespace splotchcl
