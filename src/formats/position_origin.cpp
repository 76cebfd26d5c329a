#include "formats/position_origin.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace splotchcl {
namespace {

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

std::vector<SampleRange> sample_ranges(const std::vector<std::uint64_t>& part_sizes) {
  constexpr std::uint64_t runs = 64, run_length = 64;  // few places: compressed data is costly
  std::vector<std::uint64_t> starts = {0};             // of each part among all particles
  for (const std::uint64_t size : part_sizes)
    starts.push_back(starts.back() + size);
  const std::uint64_t total = starts.back();
  const std::uint64_t step = std::max(run_length, total / runs);
  std::vector<SampleRange> ranges;
  std::size_t part = 0;
  for (std::uint64_t run = 0; run < total; run += step) {
    const std::uint64_t end = std::min(run + run_length, total);
    for (std::uint64_t at = run; at < end;) {
      while (starts[part + 1] <= at)
        ++part;
      const std::uint64_t last = std::min(end, starts[part + 1]);
      ranges.push_back({part, at - starts[part], last - at});
      at = last;
    }
  }
  return ranges;
}

Vec3 choose_position_origin(const std::vector<std::array<double, 3>>& sample) {
  Vec3 origin = {{0, 0, 0}};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const auto& position : sample) {
      const auto rounded = static_cast<double>(static_cast<float>(position[axis]));
      if (std::isfinite(rounded)) values.push_back(rounded);
    }
    origin.a[axis] = median(std::move(values));
  }
  return origin;
}

}  // namespace splotchcl
