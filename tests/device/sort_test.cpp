#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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

// Keys of 48 bits: 32 upper ones, and the ends below them.
using LongKeys = std::vector<std::uint64_t>;

Keys stable_order(const LongKeys& keys) {
  Keys order(keys.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return keys[a] < keys[b]; });
  return order;
}

Keys device_order(const LongKeys& keys) {
  DeviceContext device(choose_device(""));
  const auto count = static_cast<std::uint32_t>(keys.size());
  Keys upper(keys.size()), order(keys.size());
  std::vector<std::uint16_t> ends(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    upper[i] = static_cast<std::uint32_t>(keys[i] >> 16);
    ends[i] = static_cast<std::uint16_t>(keys[i] & 0xffffu);
  }
  std::iota(order.begin(), order.end(), 0u);
  const Buffer<std::uint32_t> sorted =
      Sorter(device).sort(device.pool.upload(upper, "keys"), device.pool.upload(ends, "ends"),
                          device.pool.upload(order, "order"), count);
  return device.pool.download(sorted, count);
}

// Numbers below 2^bits.
LongKeys random_long_keys(std::size_t count, int bits) {
  Random random(8);
  LongKeys keys(count);
  for (std::uint64_t& key : keys)
    key = static_cast<std::uint64_t>(random.uniform(0, std::ldexp(1.0, bits)));
  return keys;
}

TEST(SortOfLongKeys, GivesTheStableOrderIndexForIndex) {
  for (const std::size_t count : {0ul, 1ul, 2ul, 1025ul, 300007ul}) {
    const LongKeys keys = random_long_keys(count, 48);
    EXPECT_EQ(device_order(keys), stable_order(keys)) << count;
  }
}

// The fewer upper bits differ, the more of the ends take their place.
TEST(SortOfLongKeys, DoesWithAnyUpperBitsThatAllKeysShare) {
  for (int bits = 1; bits < 48; ++bits) {
    LongKeys keys = random_long_keys(3000, bits);
    for (std::uint64_t& key : keys)
      key += std::uint64_t{1} << bits;
    EXPECT_EQ(device_order(keys), stable_order(keys)) << bits;
  }
  EXPECT_EQ(device_order(LongKeys(5000, 77u)), stable_order(LongKeys(5000, 77u)));
}

// Runs of equal upper bits of any length, some of them across the blocks of the sort.
TEST(SortOfLongKeys, OrdersRunsOfEqualUpperBits) {
  for (const double runs : {1.0, 2.0, 50.0, 1000.0, 20000.0}) {
    for (const double ends : {1.0, 3.0, 65536.0}) {
      Random random(9);
      LongKeys keys(40000);
      for (std::uint64_t& key : keys) {
        const auto upper = static_cast<std::uint64_t>(random.uniform(0, runs));
        key = upper << 16 | static_cast<std::uint64_t>(random.uniform(0, ends));
      }
      keys.front() = std::uint64_t{1} << 47;  // so that no end takes part in the radix sort
      EXPECT_EQ(device_order(keys), stable_order(keys)) << runs << " runs, " << ends << " ends";
    }
  }
}

}  // namespace
}  // namespace splotchcl::test
