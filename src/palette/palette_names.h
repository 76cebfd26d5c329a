#pragma once

#include <optional>
#include <string>
#include <vector>

namespace splotchcl {

// The one of these names that another program means by a name of its own: in other cases of
// letters, "Viridis (matplotlib)", "Cool to Warm", "grayscale". None where it means none, or more
// than one.
std::optional<std::string> palette_named_otherwise(const std::string& name,
                                                   const std::vector<std::string>& known);

}  // namespace splotchcl
