#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "device/opencl/device_context.h"
#include "device/scenes.h"
#include "device/stages/sorter.h"

namespace splotchcl::test {
namespace {

using Keys = std::vector<std::uint32_t>;

Keys stable_order(const Keys& keys) {
  Keys order(keys.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return keys[a] < keys[b]; });
  return order;
}

Keys device_order(const Keys& keys) {
  DeviceContext device(choose_device(""));
  const auto count = static_cast<std::uint32_t>(keys.size());
  Keys order(keys.size());
  std::iota(order.begin(), order.end(), 0u);
  const Buffer<std::uint32_t> sorted = Sorter(device).sort(
      device.pool.upload(keys, "keys"), device.pool.upload(order, "order"), count);
  return device.pool.download(sorted, count);
}

Keys random_keys(std::size_t count, double low, double high) {
  Random random(7);
  Keys keys(count);
  for (std::uint32_t& key : keys)
    key = static_cast<std::uint32_t>(random.uniform(low, high));
  return keys;
}

TEST(Sort, GivesTheStableOrderIndexForIndex) {
  for (const std::size_t count : {0ul, 1ul, 2ul, 1000ul, 1024ul, 1025ul, 300007ul}) {
    const Keys keys = random_keys(count, 0, 4294967295.0);
    EXPECT_EQ(device_order(keys), stable_order(keys)) << count;
  }
}

TEST(Sort, KeepsTheOrderOfEqualKeys) {
  const Keys keys = random_keys(100000, 0, 10);
  EXPECT_EQ(device_order(keys), stable_order(keys));
}

TEST(Sort, LeavesSortedInputAlone) {
  Keys keys = random_keys(100000, 0, 4294967295.0);
  std::sort(keys.begin(), keys.end());
  EXPECT_EQ(device_order(keys), stable_order(keys));
}

TEST(Sort, TurnsReversedInputRound) {
  Keys keys = random_keys(100000, 0, 4294967295.0);
  std::sort(keys.rbegin(), keys.rend());
  EXPECT_EQ(device_order(keys), stable_order(keys));
}

TEST(Sort, ComparesKeysThatDifferInOneDigitOnly) {
  for (const double step : {1.0, 256.0, 65536.0, 16777216.0}) {
    Keys keys = random_keys(5000, 0, 256);
    for (std::uint32_t& key : keys)
      key *= static_cast<std::uint32_t>(step);
    EXPECT_EQ(device_order(keys), stable_order(keys)) << step;
  }
}

// A pass is left out for a digit that all keys share, whichever it is.
TEST(Sort, LeavesOutNoDigitInWhichKeysDiffer) {
  for (const std::uint32_t shared : {0x000000ffu, 0x0000ff00u, 0x00ff0000u, 0xff00ff00u}) {
    Keys keys = random_keys(3000, 0, 4294967295.0);
    for (std::uint32_t& key : keys)
      key = (key & ~shared) | (0x5a5a5a5au & shared);
    EXPECT_EQ(device_order(keys), stable_order(keys)) << shared;
    keys[1234] ^= shared & 0x80808080u;
    EXPECT_EQ(device_order(keys), stable_order(keys)) << "but for one key, " << shared;
  }
  EXPECT_EQ(device_order(Keys(5000, 77u)), stable_order(Keys(5000, 77u)));
}

}  // namespace
}  // namespace splotchcl::test
