#pragma once

#include <string>
#include <vector>

namespace splotchcl::test {

// A match and its groups, the whole first.
using Match = std::vector<std::string>;

// All in a text, in order. Apart from the tests that use it: <regex> takes a compiler seconds.
std::vector<Match> matches_of(const std::string& text, const std::string& pattern);

}  // namespace splotchcl::test
