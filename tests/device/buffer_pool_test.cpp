// Working memory that is kept from use to use.
#include "device/opencl/buffer_pool.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "device/stages.h"

namespace splotchcl::test {
namespace {

constexpr std::uint64_t megabyte = 1 << 20;

// What a device has of memory of its own, 0 where it uses the host's.
DeviceTraits traits_with(DeviceTraits traits, std::uint64_t gpu_memory) {
  traits.gpu_memory = gpu_memory;
  traits.shares_host_memory = gpu_memory == 0;
  return traits;
}

class Pool : public StageTest {
 protected:
  explicit Pool(std::uint64_t gpu_memory = 0)
      : own_(device().context, device().queue, device().timer,
             traits_with(device().traits, gpu_memory)) {}

  std::optional<Buffer<std::byte>> get(std::uint64_t bytes) {
    return own_.get<std::byte>(bytes, "test");
  }
  // Which memory it is: alive as long as the pool or the buffer keeps it.
  static cl_mem memory_of(const std::optional<Buffer<std::byte>>& buffer) {
    return buffer->memory().get();
  }
  // 40 megabytes that came back are the same afterwards, though so many bytes were wanted.
  void expect_kept_beside(std::uint64_t bytes) {
    auto large = get(40 * megabyte);
    const cl_mem memory = memory_of(large);
    large.reset();
    const auto other = get(bytes);
    large = get(40 * megabyte);
    EXPECT_EQ(memory_of(large), memory);
  }
  // What is held where so many bytes came back and others are wanted.
  std::uint64_t most_held(std::uint64_t came_back, std::uint64_t wanted) {
    get(came_back).reset();
    own_.reset_peak();
    const auto other = get(wanted);
    return own_.peak_bytes();
  }

  BufferPool own_;
};

class PoolOfAGpu : public Pool {
 protected:
  PoolOfAGpu() : Pool(800 * megabyte) {}
};

TEST_F(Pool, HandsOutMemoryThatCameBack) {
  auto buffer = get(10 * megabyte);
  const cl_mem memory = memory_of(buffer);
  buffer.reset();
  buffer = get(9 * megabyte);
  EXPECT_EQ(memory_of(buffer), memory);
}

TEST_F(Pool, KeepsALargeBufferWhenALittleMoreIsWanted) {
  expect_kept_beside(megabyte);
}

TEST_F(Pool, GivesFreeMemoryBackRatherThanHoldMuchMoreThanWasInUse) {
  EXPECT_LE(most_held(400 * megabyte, 100 * megabyte), 432 * megabyte);
}

TEST_F(Pool, KeepsTheBuffersOfASmallFrameForTheNext) {
  auto large = get(30 * megabyte);
  const cl_mem memory = memory_of(large);
  large.reset();
  { const auto other = get(12 * megabyte); }
  large = get(30 * megabyte);
  EXPECT_EQ(memory_of(large), memory);
}

TEST_F(Pool, GivesFreeMemoryBackWhereItsLimitIsSmall) {
  own_.expect_at_most(64 * megabyte);
  EXPECT_LE(most_held(40 * megabyte, 10 * megabyte), 42 * megabyte);
}

TEST_F(Pool, HandsOutTwoBuffersThatDoNotOverlap) {
  constexpr std::uint64_t count = 1000;
  const auto two = own_.get_two<std::uint32_t>(count, "test");
  const std::vector<std::uint32_t> ones(count, 1), twos(count, 2);
  own_.write(two[0], 0, ones.data(), count);
  own_.write(two[1], 0, twos.data(), count);
  EXPECT_EQ(own_.download(two[0], count), ones);
  EXPECT_EQ(own_.download(two[1], count), twos);
}

TEST_F(Pool, HandsOutMemoryOfTwoBuffersAsOneWhenBothCameBack) {
  auto two = std::optional(own_.get_two<std::byte>(20 * megabyte, "test"));
  const std::uint64_t total = own_.peak_bytes();
  two.reset();
  const auto large = get(40 * megabyte);
  EXPECT_EQ(own_.peak_bytes(), total);
}

TEST_F(Pool, KeepsMemoryOfTwoBuffersAsLongAsOneIsInUse) {
  auto two = own_.get_two<std::byte>(20 * megabyte, "test");
  const std::uint64_t total = own_.peak_bytes();
  two[0] = Buffer<std::byte>();
  const auto other = get(20 * megabyte);
  EXPECT_GE(own_.peak_bytes(), total + 20 * megabyte);
}

TEST_F(PoolOfAGpu, KeepsAsMuchAsWasInUse) {
  expect_kept_beside(10 * megabyte);
}

TEST_F(PoolOfAGpu, KeepsNoMoreThanASixteenthOfItsMemory) {
  EXPECT_LE(most_held(400 * megabyte, 150 * megabyte), 500 * megabyte);
}

TEST_F(PoolOfAGpu, HandsOutMemoryForAlmostTheSameSize) {
  auto buffer = get(40 * megabyte);
  const cl_mem memory = memory_of(buffer);
  buffer.reset();
  buffer = get(41 * megabyte);
  EXPECT_EQ(memory_of(buffer), memory);
}

TEST_F(PoolOfAGpu, WritesAndReadsCopiesOfMappedValues) {
  const auto buffer = own_.get<std::uint32_t>(1000, "test");
  {
    const MappedValues<std::uint32_t> written = own_.map_to_write(buffer);
    std::fill_n(written.data(), written.size(), 7u);
  }
  const MappedValues<const std::uint32_t> read = own_.map_to_read(buffer);
  ASSERT_EQ(read.size(), 1000u);
  EXPECT_EQ(std::count(read.data(), read.data() + read.size(), 7u), 1000);
}

}  // namespace
}  // namespace splotchcl::test
