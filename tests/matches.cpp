#include "matches.h"

#include <regex>

namespace splotchcl::test {

std::vector<Match> matches_of(const std::string& text, const std::string& pattern) {
  const std::regex expression(pattern);
  std::vector<Match> matches;
  for (std::sregex_iterator found(text.begin(), text.end(), expression), end; found != end; ++found)
    matches.emplace_back(found->begin(), found->end());
  return matches;
}

}  // namespace splotchcl::test
