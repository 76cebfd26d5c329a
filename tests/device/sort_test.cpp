#include "device/stages.h"
#include "device/stages/sorter.h"
#include "testing.h"

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

// The same of keys below `end`, in less time than comparing them takes.
Keys stable_order_below(std::uint32_t end, const Keys& keys) {
  std::vector<Keys> of_key(end);
  for (std::uint32_t i = 0; i < keys.size(); ++i)
    of_key[keys[i]].push_back(i);
  Keys order;
  for (const Keys& equal : of_key)
    order.insert(order.end(), equal.begin(), equal.end());
  return order;
}

// In both shapes.
class Sort : public StageTest, public testing::WithParamInterface<bool> {
 protected:
  void SetUp() override { device().traits.choose_shape(GetParam()); }

  static Keys device_order(const Keys& keys) {
    const auto count = static_cast<std::uint32_t>(keys.size());
    Keys order(keys.size());
    std::iota(order.begin(), order.end(), 0u);
    const Buffer<std::uint32_t> sorted = Sorter(device()).sort(
        device().pool.upload(keys, "keys"), {}, device().pool.upload(order, "order"), count);
    return device().pool.download(sorted, count);
  }
};

class Scan : public StageTest {};

Keys random_keys(std::size_t count, double low, double high) {
  Random random(7);
  Keys keys(count);
  for (std::uint32_t& key : keys)
    key = static_cast<std::uint32_t>(random.uniform(low, high));
  return keys;
}

TEST_P(Sort, GivesTheStableOrderIndexForIndex) {
  for (const std::size_t count : {0ul, 1ul, 2ul, 1000ul, 1024ul, 1025ul, 300007ul}) {
    const Keys keys = random_keys(count, 0, 4294967295.0);
    EXPECT_EQ(device_order(keys), stable_order(keys)) << count;
  }
}

// One pass and three end in the scratch memory, two and four in the values' own.
TEST_P(Sort, NeverLeavesTheOrderInScratchMemory) {
  constexpr std::uint32_t count = 5000;
  for (const double most : {255.0, 65535.0, 16777215.0, 4294967295.0}) {
    const Keys keys = random_keys(count, 0, most);
    Keys order(count);
    std::iota(order.begin(), order.end(), 0u);
    BufferPool& pool = device().pool;
    auto [sort_keys, scratch] = pool.get_two<std::uint32_t>(count, "sort keys");
    pool.write(sort_keys, 0, keys.data(), count);
    KeyedSplats keyed;
    keyed.count = count;
    keyed.keys = std::move(sort_keys);
    keyed.scratch = std::move(scratch);
    keyed.order = pool.upload(order, "order");
    const SortedSplats sorted = Sorter(device()).sort(std::move(keyed));
    EXPECT_EQ(pool.download(sorted.order, count), stable_order(keys)) << most;
    cl_mem whole = nullptr;
    clGetMemObjectInfo(sorted.order.memory().get(), CL_MEM_ASSOCIATED_MEMOBJECT, sizeof(whole),
                       &whole, nullptr);
    EXPECT_EQ(whole, nullptr) << most;
  }
}

// Also on a simulator (scripts/test --icd oclgrind).
TEST_P(Sort, KeepsTheOrderOfEqualKeys) {
  const Keys keys = random_keys(10000, 0, 10);
  EXPECT_EQ(device_order(keys), stable_order(keys));
}

TEST_P(Sort, LeavesSortedInputAlone) {
  Keys keys = random_keys(100000, 0, 4294967295.0);
  std::sort(keys.begin(), keys.end());
  EXPECT_EQ(device_order(keys), stable_order(keys));
}

TEST_P(Sort, TurnsReversedInputRound) {
  Keys keys = random_keys(100000, 0, 4294967295.0);
  std::sort(keys.rbegin(), keys.rend());
  EXPECT_EQ(device_order(keys), stable_order(keys));
}

TEST_P(Sort, ComparesKeysThatDifferInOneDigitOnly) {
  for (const double step : {1.0, 256.0, 65536.0, 16777216.0}) {
    Keys keys = random_keys(5000, 0, 256);
    for (std::uint32_t& key : keys)
      key *= static_cast<std::uint32_t>(step);
    EXPECT_EQ(device_order(keys), stable_order(keys)) << step;
  }
}

// A pass is left out for a digit that all keys share, whichever it is.
TEST_P(Sort, LeavesOutNoDigitInWhichKeysDiffer) {
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

// The last group of a sort by work-groups, and the last stretch of its scans, may be full, empty
// but for one pair, or short of one.
TEST_P(Sort, TakesAnyNumberOfPairsAroundPowersOfTwo) {
  const int largest = long_tests() ? 24 : 20;
  for (int k = 1; k <= largest; ++k) {
    for (const int beside : {-1, 0, 1}) {
      const Keys keys =
          random_keys((std::size_t{1} << k) + static_cast<std::size_t>(beside), 0, 1000);
      ASSERT_EQ(device_order(keys), stable_order_below(1000, keys)) << "2^" << k << " + " << beside;
    }
  }
}

TEST_P(Sort, FindsTheOneKeyThatDiffers) {
  for (const std::uint32_t other : {0u, 76u, 78u, 0xffffffffu}) {
    for (const std::size_t place : {0ul, 2047ul, 2048ul, 4999ul}) {
      Keys keys(5000, 77u);
      keys[place] = other;
      EXPECT_EQ(device_order(keys), stable_order(keys)) << other << " at " << place;
    }
  }
}

// Keys within a range that begins anywhere have as many digits as the range.
TEST_P(Sort, DoesWithTheDigitsOfTheirRange) {
  for (const double range : {2.0, 16.0, 300.0, 70000.0}) {
    const Keys keys = random_keys(5000, 4000000000.0 - range, 4000000000.0);
    EXPECT_EQ(device_order(keys), stable_order(keys)) << range;
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, Sort, testing::Bool(),
                         [](const auto& info) { return info.param ? "rows" : "groups"; });

TEST(DigitPlan, HasTheFewestDigitsOfEqualLength) {
  const DigitPlan plan = digits_of_bits(14);
  ASSERT_EQ(plan.digits.size(), 2u);
  EXPECT_EQ(plan.digits[0].bits, 7u);
  EXPECT_EQ(plan.digits[1].shift, 7u);
  EXPECT_EQ(plan.digits[1].bits, 7u);
  EXPECT_TRUE(digits_of_bits(0).digits.empty());
  EXPECT_EQ(digits_of_bits(32).digits.size(), 4u);
}

TEST(DigitPlan, SubtractsTheSmallestKeyWhereThatSavesADigit) {
  EXPECT_EQ(digits_of_range({0x01ffff00, 0x02000010, {0x03ffffff, 0}}).digits.size(), 2u);
  // These differ in one digit only, far above the lowest bit.
  EXPECT_EQ(digits_of_range({0, 0x7f000000, {0x7f000000, 0}}).digits.size(), 1u);
}

// More pairs than there is memory for, by counting alone. Kernels find places in 32 bits: these
// must not wrap around in the last group.
TEST(SizesOfSorts, AreThoseOf64BitsFor2To31PairsAndMore) {
  for (const std::uint32_t count :
       {(1u << 31) - 1, 1u << 31, (1u << 31) + 1, 0xffffffffu - (1u << 20)}) {
    const SortSizes sizes = sizes_of_sort(count);
    const std::uint64_t reached = std::uint64_t{sizes.groups} * SORT_STRETCH;
    EXPECT_GE(reached, count);
    EXPECT_LT(reached - count, SORT_STRETCH);
    const std::uint32_t last_in_kernels = (sizes.groups - 1) * SORT_STRETCH + (SORT_STRETCH - 1);
    EXPECT_EQ(last_in_kernels, reached - 1);
    EXPECT_EQ(sizes.counters, std::uint64_t{256} * sizes.groups);
    EXPECT_EQ(sizes.pair_bytes, 8ull * count);
    EXPECT_EQ(sizes.counter_bytes, 4 * (256ull * sizes.groups + 1));
  }
  EXPECT_EQ(sizes_of_sort(1u << 31).groups, 1u << 20);
  EXPECT_EQ(sizes_of_sort((1u << 31) + 1).groups, (1u << 20) + 1);
}

// Around the lengths at which one more step is needed.
TEST_F(Scan, GivesExclusiveSumsAndTheirTotal) {
  for (const std::uint32_t count : {0u, 1u, 255u, 256u, 2047u, 2048u, 2049u, 300000u, 4194305u}) {
    Random random(11);
    std::vector<std::uint32_t> values(count + 1);
    for (std::uint32_t& value : values)
      value = static_cast<std::uint32_t>(random.uniform(0, 100));
    const auto buffer = device().pool.upload(values, "values");
    GroupScan(device()).scan("test", buffer, count);
    std::uint32_t sum = 0;
    for (std::uint32_t i = 0; i < count; ++i)
      sum += std::exchange(values[i], sum);
    values[count] = sum;
    EXPECT_EQ(device().pool.download(buffer, count + 1), values) << count;
  }
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

class SortOfLongKeys : public Sort {
 protected:
  static Keys device_order(const LongKeys& keys) {
    const auto count = static_cast<std::uint32_t>(keys.size());
    Keys upper(keys.size()), order(keys.size());
    std::vector<std::uint16_t> ends(keys.size());
    for (std::size_t i = 0; i < keys.size(); ++i) {
      upper[i] = static_cast<std::uint32_t>(keys[i] >> 16);
      ends[i] = static_cast<std::uint16_t>(keys[i] & 0xffffu);
    }
    std::iota(order.begin(), order.end(), 0u);
    BufferPool& pool = device().pool;
    const Buffer<std::uint32_t> sorted = Sorter(device()).sort(
        pool.upload(upper, "keys"), pool.upload(ends, "ends"), pool.upload(order, "order"), count);
    return pool.download(sorted, count);
  }
};

// Numbers below 2^bits.
LongKeys random_long_keys(std::size_t count, int bits) {
  Random random(8);
  LongKeys keys(count);
  for (std::uint64_t& key : keys)
    key = static_cast<std::uint64_t>(random.uniform(0, std::ldexp(1.0, bits)));
  return keys;
}

TEST_P(SortOfLongKeys, GivesTheStableOrderIndexForIndex) {
  for (const std::size_t count : {0ul, 1ul, 2ul, 1025ul, 300007ul}) {
    const LongKeys keys = random_long_keys(count, 48);
    EXPECT_EQ(device_order(keys), stable_order(keys)) << count;
  }
}

// The fewer upper bits differ, the more of the ends take their place.
TEST_P(SortOfLongKeys, DoesWithAnyUpperBitsThatAllKeysShare) {
  for (int bits = 1; bits < 48; ++bits) {
    LongKeys keys = random_long_keys(3000, bits);
    for (std::uint64_t& key : keys)
      key += std::uint64_t{1} << bits;
    EXPECT_EQ(device_order(keys), stable_order(keys)) << bits;
  }
  EXPECT_EQ(device_order(LongKeys(5000, 77u)), stable_order(LongKeys(5000, 77u)));
}

// Runs of equal upper bits of any length, some of them across the blocks of the sort.
TEST_P(SortOfLongKeys, OrdersRunsOfEqualUpperBits) {
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

// Few long runs, in which ends come in any order.
TEST_P(SortOfLongKeys, OrdersLongRunsAmongOthers) {
  Random random(10);
  LongKeys keys(20000);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const double run = i % 4 == 0 ? 5 : random.uniform(0, 4294967295.0);
    keys[i] = static_cast<std::uint64_t>(run) << 16 |
              static_cast<std::uint64_t>(random.uniform(0, 65536));
  }
  EXPECT_EQ(device_order(keys), stable_order(keys));
}

INSTANTIATE_TEST_SUITE_P(Shapes, SortOfLongKeys, testing::Bool(),
                         [](const auto& info) { return info.param ? "rows" : "groups"; });

}  // namespace
}  // namespace splotchcl::test
