#include "measure.h"

#include <algorithm>
#include <chrono>
#include <limits>

namespace splotchcl::bench {
namespace {

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

Cost now() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto since_epoch = std::chrono::steady_clock::now().time_since_epoch();
  return {std::chrono::duration<double>(since_epoch).count(), cpu_seconds(usage)};
}

std::vector<double> each(const std::vector<Cost>& costs, double Cost::*part) {
  std::vector<double> values;
  for (const Cost& cost : costs)
    values.push_back(cost.*part);
  return values;
}

double least(const std::vector<double>& values) {
  return values.empty() ? std::numeric_limits<double>::quiet_NaN()
                        : *std::min_element(values.begin(), values.end());
}

}  // namespace

double cpu_seconds(const rusage& usage) {
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

Stopwatch::Stopwatch() : start_(now()) {}

Cost Stopwatch::elapsed() const {
  const Cost end = now();
  return {end.wall_seconds - start_.wall_seconds, end.cpu_seconds - start_.cpu_seconds};
}

double median_of(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  if (values.size() % 2 == 1) return values[middle];
  return 0.5 * (values[middle - 1] + values[middle]);
}

Cost Runs::mean() const {
  Cost mean;
  for (const Cost& cost : costs_) {
    mean.wall_seconds += cost.wall_seconds / static_cast<double>(costs_.size());
    mean.cpu_seconds += cost.cpu_seconds / static_cast<double>(costs_.size());
  }
  return mean;
}

Cost Runs::median() const {
  return {median_of(each(costs_, &Cost::wall_seconds)),
          median_of(each(costs_, &Cost::cpu_seconds))};
}

Cost Runs::minimum() const {
  return {least(each(costs_, &Cost::wall_seconds)), least(each(costs_, &Cost::cpu_seconds))};
}

Runs measure(int count, const std::function<void()>& work) {
  work();
  Runs runs;
  for (int i = 0; i < count; ++i) {
    const Stopwatch stopwatch;
    work();
    runs.add(stopwatch.elapsed());
  }
  return runs;
}

}  // namespace splotchcl::bench
