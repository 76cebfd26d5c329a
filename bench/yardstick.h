#pragma once

#include <string>
#include <vector>

namespace splotchcl::bench {

// How fast this machine can add splats into image tiles right now, done by hand with the
// compiler's vectors of eight floats. Not a renderer: its splats lie in the lists of their
// tiles before the clock starts, and its exponential has a relative error of 2e-6. What a
// frame takes is judged by the ratio to this, measured in the same minute.
struct YardstickCost {
  float radius_pixels = 0;  // mean; sigma = radius / 1.8
  double additive_ns = 0;   // per pixel update of three channels
  double ordered_ns = 0;
};

// The best of `runs` runs of each kind, with as many threads.
YardstickCost measure_yardstick(float radius_pixels, int splat_count, int threads, int runs);

// One number for the machine of the moment: the costs of the two sizes that matter most in
// large snapshots, and their geometric mean.
struct Yardstick {
  YardstickCost small, large;  // 5 and 20 pixels
  int threads = 1;
  double additive_ns() const;
  double ordered_ns() const;
};
Yardstick measure_yardstick(int threads);
std::string describe(const Yardstick& yardstick);

}  // namespace splotchcl::bench
