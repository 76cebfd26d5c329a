#include "multiply_adds.h"

#include <algorithm>
#include <cstddef>
#include <thread>
#include <vector>

#include "measure.h"

namespace splotchcl::bench {
namespace {

#ifdef __AVX512F__
constexpr int vector_bytes = 64;
#else
constexpr int vector_bytes = 32;
#endif
using Floats = float __attribute__((vector_size(vector_bytes)));
constexpr std::size_t lanes = vector_bytes / sizeof(float);
// As many as are under way at a time where each takes four or five cycles and two begin in one.
constexpr std::size_t chains = 10;

// What nobody needs, so that it is computed.
volatile float factor = 0.5f, unused_product;

__attribute__((noinline)) void multiply_and_add(long steps) {
  const Floats by = Floats{} + factor, added = Floats{} + 1.0f;
  Floats sums[chains];
  for (std::size_t c = 0; c < chains; ++c)
    sums[c] = Floats{} + static_cast<float>(c);
  for (long step = 0; step < steps; ++step) {
    for (std::size_t c = 0; c < chains; ++c)
      sums[c] = sums[c] * by + added;
  }
  Floats all = sums[0];
  for (std::size_t c = 1; c < chains; ++c)
    all += sums[c];
  unused_product = all[0];
}

}  // namespace

double measure_multiply_adds(int threads) {
  constexpr int runs = 5;
  constexpr long steps = 5000000;
  const double of_run = static_cast<double>(steps) * chains * lanes * threads;
  double best = 0;
  for (int run = 0; run < runs; ++run) {
    const Stopwatch stopwatch;
    std::vector<std::thread> others;
    for (int t = 1; t < threads; ++t)
      others.emplace_back(multiply_and_add, steps);
    multiply_and_add(steps);
    for (std::thread& other : others)
      other.join();
    best = std::max(best, of_run / stopwatch.elapsed().wall_seconds);
  }
  return best;
}

}  // namespace splotchcl::bench
