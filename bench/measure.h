#pragma once

#include <sys/resource.h>

#include <functional>
#include <vector>

namespace splotchcl::bench {

// What a piece of work cost. On a machine that others use too, CPU seconds of the whole
// process say more than wall seconds.
struct Cost {
  double wall_seconds = 0;
  double cpu_seconds = 0;  // user and system, all threads
};

// Of the user and of the system.
double cpu_seconds(const rusage& usage);

class Stopwatch {
 public:
  Stopwatch();
  Cost elapsed() const;

 private:
  Cost start_;
};

// Several runs of the same work. The median is what to expect here and now, the minimum
// what the work takes when nobody disturbs it.
class Runs {
 public:
  void add(const Cost& cost) { costs_.push_back(cost); }
  std::size_t count() const { return costs_.size(); }
  Cost mean() const;
  Cost median() const;
  Cost minimum() const;

 private:
  std::vector<Cost> costs_;
};

// Runs the work once unmeasured, which compiles kernels and fills caches, then `count`
// times.
Runs measure(int count, const std::function<void()>& work);

double median_of(std::vector<double> values);  // NaN of none

}  // namespace splotchcl::bench
