#pragma once

namespace splotchcl::bench {

// Multiplications with an addition of floats, a second, that this machine does right now, all
// threads together: in as wide vectors as it has, in registers alone, the best of several runs.
double measure_multiply_adds(int threads);

}  // namespace splotchcl::bench
