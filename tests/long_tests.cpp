#include "long_tests.h"

#include <cstdlib>

namespace splotchcl::test {

bool long_tests() {
  const char* const value = std::getenv("SPLOTCHCL_LONG_TESTS");
  return value != nullptr && *value != '\0';
}

std::vector<std::uint64_t> seeds(std::uint64_t first, std::uint64_t last, std::uint64_t every) {
  std::vector<std::uint64_t> chosen;
  for (std::uint64_t seed = first; seed <= last; seed += long_tests() ? 1 : every)
    chosen.push_back(seed);
  return chosen;
}

int rounds(int all) {
  if (long_tests()) return all;
  constexpr int share = SPLOTCHCL_SHARE_OF_ROUNDS;
  return (all + share - 1) / share;
}

}  // namespace splotchcl::test
