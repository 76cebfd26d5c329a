// Sorting pairs of key and index: the project's own sort beside std::stable_sort and the
// sort of Boost.Compute, on the same keys in the same run.
#include <boost/compute/algorithm/sort_by_key.hpp>
#include <boost/compute/container/vector.hpp>
#include <boost/compute/iterator/buffer_iterator.hpp>
#include <numeric>
#include <utility>

#include "device/stages/sorter.h"
#include "stages/timed.h"
#include "synthetic.h"

namespace splotchcl::bench {
namespace {

using Numbers = std::vector<std::uint32_t>;

struct KeySet {
  const char* name;
  Numbers (*make)(std::size_t count);
};

Numbers random_keys(std::size_t count) {
  Random random(11);
  Numbers keys(count);
  for (std::uint32_t& key : keys)
    key = random.bits();
  return keys;
}

Numbers sorted_keys(std::size_t count) {
  Numbers keys = random_keys(count);
  std::sort(keys.begin(), keys.end());
  return keys;
}

// Of four digits of eight bits only the second and the fourth differ.
Numbers keys_with_constant_digits(std::size_t count) {
  Numbers keys = random_keys(count);
  for (std::uint32_t& key : keys)
    key = (key & 0x00ff00ffu) | 0x40003f00u;
  return keys;
}

constexpr KeySet key_sets[] = {{"random", random_keys},
                               {"sorted", sorted_keys},
                               {"constant_digits", keys_with_constant_digits}};

Numbers indices(std::size_t count) {
  Numbers values(count);
  std::iota(values.begin(), values.end(), 0u);
  return values;
}

// A sort that does not sort is no baseline: the last iteration's order is looked at.
void check(benchmark::State& state, const Numbers& keys, const Numbers& order, bool stable) {
  for (std::size_t i = 1; i < order.size(); ++i) {
    const std::uint32_t before = keys[order[i - 1]], here = keys[order[i]];
    if (before > here || (stable && before == here && order[i - 1] > order[i])) {
      state.SkipWithError("the result is not in order");
      return;
    }
  }
}

void sort_on_device(benchmark::State& state, DeviceContext& device, const Numbers& keys) {
  const Numbers values = indices(keys.size());
  Numbers order(keys.size());
  PieceTimer timer(state);
  for (auto _ : state) {
    Buffer<std::uint32_t> device_keys = device.pool.upload(keys, "keys");
    Buffer<std::uint32_t> device_values = device.pool.upload(values, "values");
    Buffer<std::uint32_t> sorted;
    device.queue.finish();
    timer.time([&] {
      sorted = Sorter(device).sort(std::move(device_keys), {}, std::move(device_values),
                                   static_cast<std::uint32_t>(keys.size()));
      device.queue.finish();
    });
    order = device.pool.download(sorted, keys.size());
    device.timer.clear();
  }
  check(state, keys, order, true);
  timer.count("pairs", static_cast<double>(keys.size()));
}

void sort_with_boost(benchmark::State& state, DeviceContext& device, const Numbers& keys) {
  const Numbers values = indices(keys.size());
  Numbers order(keys.size());
  compute::vector<std::uint32_t> device_keys(keys.size(), device.context);
  compute::vector<std::uint32_t> device_values(keys.size(), device.context);
  PieceTimer timer(state);
  for (auto _ : state) {
    compute::copy(keys.begin(), keys.end(), device_keys.begin(), device.queue);
    compute::copy(values.begin(), values.end(), device_values.begin(), device.queue);
    device.queue.finish();
    timer.time([&] {
      compute::sort_by_key(device_keys.begin(), device_keys.end(), device_values.begin(),
                           device.queue);
      device.queue.finish();
    });
    compute::copy(device_values.begin(), device_values.end(), order.begin(), device.queue);
  }
  check(state, keys, order, false);
  timer.count("pairs", static_cast<double>(keys.size()));
}

void sort_with_std(benchmark::State& state, const Numbers& keys) {
  using Pair = std::pair<std::uint32_t, std::uint32_t>;
  std::vector<Pair> pairs(keys.size());
  PieceTimer timer(state);
  for (auto _ : state) {
    for (std::size_t i = 0; i < keys.size(); ++i)
      pairs[i] = {keys[i], static_cast<std::uint32_t>(i)};
    timer.time([&] {
      std::stable_sort(pairs.begin(), pairs.end(),
                       [](const Pair& a, const Pair& b) { return a.first < b.first; });
    });
  }
  Numbers order;
  for (const Pair& pair : pairs)
    order.push_back(pair.second);
  check(state, keys, order, true);
  timer.count("pairs", static_cast<double>(keys.size()));
}

}  // namespace

void add_sort_benchmarks(const Setting& setting) {
  std::vector<std::pair<std::string, std::size_t>> sizes = {{"1M", std::size_t{1} << 20}};
  if (!setting.quick) sizes.push_back({"16M", std::size_t{1} << 24});
  if (setting.large) sizes.push_back({"64M", std::size_t{1} << 26});
  DeviceContext& device = setting.device;
  for (const auto& [size_name, count] : sizes) {
    for (const KeySet& set : key_sets) {
      const std::string name = std::string("/") + set.name + "/" + size_name;
      const auto keys =
          std::make_shared<Lazy<Numbers>>([set, count = count] { return set.make(count); });
      add_benchmark("sort" + name, [keys, &device](benchmark::State& state) {
        sort_on_device(state, device, keys->get());
      });
      add_benchmark("sort_std_stable" + name,
                    [keys](benchmark::State& state) { sort_with_std(state, keys->get()); });
      add_benchmark("sort_boost_compute" + name, [keys, &device](benchmark::State& state) {
        sort_with_boost(state, device, keys->get());
      });
    }
  }
}

}  // namespace splotchcl::bench
