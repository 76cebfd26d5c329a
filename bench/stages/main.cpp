// Every stage alone, and whole frames, with Google Benchmark: `--help` for our options; all
// options of Google Benchmark (--benchmark_filter=..., --benchmark_out=FILE) work too.
#include <benchmark/benchmark.h>

#include "arguments.h"
#include "machine.h"
#include "stages/timed.h"

namespace splotchcl::bench {
namespace {

// Given after our defaults, so that they win.
std::vector<std::string> google_words;

void run(const Arguments& arguments) {
  const std::string device_name = arguments.text("device", "");
  const Machine machine = describe_machine(device_name);
  DeviceContext device(choose_device(device_name));
  const Setting setting = {device, device_name, machine.threads(), arguments.has("quick"),
                           arguments.has("large")};
  benchmark::AddCustomContext("device", machine.device.name);
  benchmark::AddCustomContext("driver", machine.device.platform + " " + machine.device.driver);
  benchmark::AddCustomContext("threads", std::to_string(machine.threads()));
  benchmark::AddCustomContext("vector_floats", std::to_string(machine.vector_floats));
  benchmark::AddCustomContext("processor", machine.processor);

  std::vector<std::string> words = {
      "bench_stages", "--benchmark_repetitions=5", "--benchmark_report_aggregates_only=true",
      setting.quick ? "--benchmark_min_time=0.02" : "--benchmark_min_time=0.1"};
  words.insert(words.end(), google_words.begin(), google_words.end());
  std::vector<char*> pointers;
  for (std::string& word : words)
    pointers.push_back(word.data());
  int count = static_cast<int>(pointers.size());
  benchmark::Initialize(&count, pointers.data());
  add_yardstick_benchmarks(setting);
  add_stage_benchmarks(setting);
  add_composite_benchmarks(setting);
  add_frame_benchmarks(setting);
  add_sort_benchmarks(setting);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}

}  // namespace
}  // namespace splotchcl::bench

int main(int count, char** words) {
  std::vector<char*> own_words;
  for (int i = 0; i < count; ++i) {
    const std::string word = words[i];
    if (word.rfind("--benchmark_", 0) == 0) {
      splotchcl::bench::google_words.push_back(word);
    } else {
      own_words.push_back(words[i]);
    }
  }
  return splotchcl::bench::run_main(
      static_cast<int>(own_words.size()), own_words.data(),
      {"quick: small sizes", "large: also 64 M pairs and 16 M particles",
       "device=NAME: part of a device's name"},
      splotchcl::bench::run);
}
