// Made-up snapshots: a million particles are to take less than ten seconds.
#include "splotchcl/generate.h"

#include <benchmark/benchmark.h>

namespace splotchcl::bench {
namespace {

void generate(benchmark::State& state,
              GeneratedSnapshot (*generator)(const GenerateSettings& settings)) {
  GenerateSettings settings;
  settings.particles = static_cast<std::uint64_t>(state.range(0));
  for (auto _ : state)
    benchmark::DoNotOptimize(generator(settings));
  state.counters["particles"] = static_cast<double>(state.range(0));
}

BENCHMARK_CAPTURE(generate, universe, &generate_universe)
    ->Arg(100000)
    ->Arg(1000000)
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(generate, cluster, &generate_cluster)
    ->Arg(100000)
    ->Arg(1000000)
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(generate, halo, &generate_halo)
    ->Arg(100000)
    ->Arg(1000000)
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();

}  // namespace
}  // namespace splotchcl::bench

BENCHMARK_MAIN();
