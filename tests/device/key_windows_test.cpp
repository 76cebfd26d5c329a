// Windows of sort keys: which splats of a frame are drawn together where not all have room.
#include "device/frame/key_windows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace splotchcl::test {
namespace {

CountedKeys count(const std::vector<std::uint64_t>& keys, const KeyWindow& window, int shift) {
  CountedKeys counted{window, shift, std::vector<std::uint64_t>(1 << 16)};
  for (const std::uint64_t key : keys) {
    if (key >= window.first && key < window.end) ++counted.bins[key >> shift & 0xffff];
  }
  return counted;
}

std::vector<KeyWindow> windows_of(const std::vector<std::uint64_t>& keys, std::uint64_t capacity) {
  return choose_windows(count(keys, {}, 32), capacity, [&](const KeyWindow& window, int shift) {
    return count(keys, window, shift);
  });
}

// Every key lies in one window, windows ascend, and their numbers of splats are true.
void expect_to_hold(const std::vector<KeyWindow>& windows, const std::vector<std::uint64_t>& keys) {
  std::size_t in_windows = 0;
  for (std::size_t w = 0; w < windows.size(); ++w) {
    EXPECT_LT(windows[w].first, windows[w].end);
    if (w > 0) {
      EXPECT_GE(windows[w].first, windows[w - 1].end);
    }
    const auto held = std::count_if(keys.begin(), keys.end(), [&](std::uint64_t key) {
      return key >= windows[w].first && key < windows[w].end;
    });
    EXPECT_EQ(windows[w].splats, static_cast<std::uint64_t>(held));
    in_windows += windows[w].splats;
  }
  EXPECT_EQ(in_windows, keys.size());
}

TEST(KeyWindows, HoldEveryKeyOnce) {
  std::vector<std::uint64_t> keys;
  for (std::uint64_t i = 0; i < 5000; ++i)
    keys.push_back(i * 0x9e3779b97f4a7c15u >> 16);
  for (const std::uint64_t capacity : {5000u, 2500u, 700u, 100u}) {
    const std::vector<KeyWindow> windows = windows_of(keys, capacity);
    expect_to_hold(windows, keys);
    for (const KeyWindow& window : windows)
      EXPECT_LE(window.splats, capacity);
    EXPECT_LE(windows.size(), 2 * keys.size() / capacity + 1) << "windows are well filled";
  }
}

TEST(KeyWindows, TellKeysApartByTheirLastBits) {
  std::vector<std::uint64_t> keys;
  for (std::uint64_t i = 0; i < 300; ++i)
    keys.push_back(0x123456780000u + i % 100);
  const std::vector<KeyWindow> windows = windows_of(keys, 10);
  expect_to_hold(windows, keys);
  for (const KeyWindow& window : windows)
    EXPECT_LE(window.splats, 10u);
}

TEST(KeyWindows, HoldMoreThanTheirRoomOfOneKeyAlone) {
  std::vector<std::uint64_t> keys(50, 0x7fff00010002u);
  keys.push_back(0x7fff00010001u);
  keys.push_back(0x7fff00010003u);
  const std::vector<KeyWindow> windows = windows_of(keys, 20);
  expect_to_hold(windows, keys);
  ASSERT_EQ(windows.size(), 3u);
  EXPECT_EQ(windows[1].splats, 50u);
}

TEST(KeyWindows, HoldTheSmallestAndTheLargestKey) {
  const std::vector<std::uint64_t> keys = {0, end_of_keys - 1};
  expect_to_hold(windows_of(keys, 1), keys);
  expect_to_hold(windows_of(keys, 2), keys);
}

TEST(KeyWindows, AreNoneOfNoSplats) {
  EXPECT_TRUE(windows_of({}, 10).empty());
}

}  // namespace
}  // namespace splotchcl::test
