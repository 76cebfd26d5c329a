#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "device/opencl/device_context.h"
#include "measure.h"

namespace splotchcl::bench {

// What every benchmark of the stages gets.
struct Setting {
  DeviceContext& device;
  std::string device_name;  // as the user gave it
  int threads = 1;
  bool quick = false;  // small sizes only
  bool large = false;  // also those that take gigabytes and minutes
};

// Times one piece of each iteration. What lies around it (filling buffers again) is not
// counted. The CPU time of the whole process for the piece is the counter cpu_ms.
class PieceTimer {
 public:
  explicit PieceTimer(benchmark::State& state) : state_(state) {}

  template <class Work>
  void time(Work work) {
    const Stopwatch stopwatch;
    work();
    const Cost cost = stopwatch.elapsed();
    state_.SetIterationTime(cost.wall_seconds);
    runs_.add(cost);
  }

  // The work of one iteration, as a rate ...
  void count(const std::string& what, double amount) {
    report_cpu();
    state_.counters[what + "/s"] = benchmark::Counter(amount / runs_.mean().wall_seconds);
  }
  // ... or as the time for one of what it is made of.
  void count_nanoseconds(const std::string& per, double amount) {
    report_cpu();
    state_.counters["ns/" + per] = benchmark::Counter(1e9 * runs_.mean().wall_seconds / amount);
  }

 private:
  void report_cpu() { state_.counters["cpu_ms"] = 1e3 * runs_.mean().cpu_seconds; }

  benchmark::State& state_;
  Runs runs_;
};

// What several benchmarks share, made when the first of them runs.
template <class T>
class Lazy {
 public:
  explicit Lazy(std::function<T()> make) : make_(std::move(make)) {}
  const T& get() {
    if (!value_) value_ = make_();
    return *value_;
  }

 private:
  std::function<T()> make_;
  std::optional<T> value_;
};

inline double smallest_of(const std::vector<double>& values) {
  return *std::min_element(values.begin(), values.end());
}

// Registers a benchmark: medians and minima over repetitions, wall clock of its pieces.
inline void add_benchmark(const std::string& name,
                          const std::function<void(benchmark::State&)>& body) {
  benchmark::RegisterBenchmark(name.c_str(), body)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond)
      ->ComputeStatistics("min", smallest_of);
}

void add_yardstick_benchmarks(const Setting& setting);
void add_sort_benchmarks(const Setting& setting);
void add_stage_benchmarks(const Setting& setting);
void add_composite_benchmarks(const Setting& setting);
void add_frame_benchmarks(const Setting& setting);

}  // namespace splotchcl::bench
