#pragma once

#include <cstdint>
#include <vector>

namespace splotchcl::test {

// Whether everything is to be run, however long it takes, as with scripts/test --long; else
// a sample of it that shows every behavior. SPLOTCHCL_LONG_TESTS says so: not empty.
bool long_tests();

// The seeds from `first` to `last` of a property test over random scenes: all of them in long
// tests, else every seventh, or thirteenth, which meets what follows from a seed modulo 2, 3 or 5.
std::vector<std::uint64_t> seeds(std::uint64_t first, std::uint64_t last, std::uint64_t every = 7);

// Of so many rounds with random input: all of them in long tests, else a fifth, or a fiftieth in
// the sanitizers' build.
int rounds(int all);

}  // namespace splotchcl::test
