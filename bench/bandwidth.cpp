#include "bandwidth.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <thread>
#include <vector>

#include "measure.h"

namespace splotchcl::bench {
namespace {

// The share of one thread in a walk.
struct Part {
  std::size_t first, end;
};

// Where sums go that nobody needs, so that they are computed.
volatile float unused_sum;

// Calls: a loop around them must not be merged with theirs.
__attribute__((noinline)) void read(const std::vector<float>& from, Part part) {
  float sum = 0;
  for (std::size_t i = part.first; i < part.end; ++i)
    sum += from[i];
  unused_sum = sum;
}

__attribute__((noinline)) void scale(const std::vector<float>& from, std::vector<float>& to,
                                     Part part) {
  const float* __restrict source = from.data();
  float* __restrict target = to.data();
  for (std::size_t i = part.first; i < part.end; ++i)
    target[i] = 0.5f * source[i];
}

__attribute__((noinline)) void add(const std::vector<float>& first,
                                   const std::vector<float>& second, std::vector<float>& to,
                                   Part part) {
  const float* __restrict a = first.data();
  const float* __restrict b = second.data();
  float* __restrict target = to.data();
  for (std::size_t i = part.first; i < part.end; ++i)
    target[i] = a[i] + 0.5f * b[i];
}

void on_threads(int threads, std::size_t length, const std::function<void(Part)>& work) {
  const auto count = static_cast<std::size_t>(threads);
  const auto part_of = [&](std::size_t t) -> Part {
    return {length * t / count, length * (t + 1) / count};
  };
  std::vector<std::thread> others;
  for (std::size_t t = 1; t < count; ++t)
    others.emplace_back(work, part_of(t));
  work(part_of(0));
  for (std::thread& other : others)
    other.join();
}

// Bytes a second of the best of some runs, each long enough that starting threads does not show.
double best_rate(double bytes_of_walk, int threads, std::size_t length,
                 const std::function<void(Part)>& walk) {
  constexpr int runs = 5;
  constexpr double bytes_of_run = 1e9;
  const int walks = std::max(1, static_cast<int>(bytes_of_run / bytes_of_walk));
  double best = 0;
  for (int run = 0; run < runs; ++run) {
    const Stopwatch stopwatch;
    on_threads(threads, length, [&](Part part) {
      for (int i = 0; i < walks; ++i)
        walk(part);
    });
    best = std::max(best, walks * bytes_of_walk / stopwatch.elapsed().wall_seconds);
  }
  return best;
}

}  // namespace

double measure_bandwidth(std::uint64_t bytes, int threads) {
  const std::size_t floats = std::max<std::size_t>(3 * 1024, bytes / sizeof(float));
  const double float_bytes = sizeof(float);
  double best = 0;
  {
    const std::vector<float> from(floats, 1.0f);
    best = best_rate(float_bytes * static_cast<double>(floats), threads, floats,
                     [&](Part part) { read(from, part); });
  }
  {
    const std::size_t length = floats / 2;
    const std::vector<float> from(length, 1.0f);
    std::vector<float> to(length);
    best = std::max(best, best_rate(3 * float_bytes * static_cast<double>(length), threads, length,
                                    [&](Part part) { scale(from, to, part); }));
  }
  const std::size_t length = floats / 3;
  const std::vector<float> first(length, 1.0f), second(length, 1.0f);
  std::vector<float> to(length);
  return std::max(best, best_rate(4 * float_bytes * static_cast<double>(length), threads, length,
                                  [&](Part part) { add(first, second, to, part); }));
}

}  // namespace splotchcl::bench
