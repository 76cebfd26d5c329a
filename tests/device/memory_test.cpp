#include <malloc.h>

#include "device/opencl/buffer_pool.h"
#include "device/opencl/staged_copies.h"
#include "device/stages.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// Working memory that is kept from use to use.

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

constexpr std::size_t mebibyte = 1 << 20;

class Pages : public StageTest {
 protected:
  void SetUp() override {
    if (!device().traits.large_pages) GTEST_SKIP() << "not a processor through PoCL";
  }

  // Where the device keeps a buffer.
  std::uintptr_t address_of(const compute::buffer& buffer) {
    void* const at = device().queue.enqueue_map_buffer(buffer, CL_MAP_READ, 0, buffer.size());
    device().queue.enqueue_unmap_buffer(buffer, at);
    device().queue.finish();
    return reinterpret_cast<std::uintptr_t>(at);
  }
};

TEST_F(Pages, KeepWhatIsWrittenToTheirEnds) {
  std::vector<std::uint32_t> values(5 * mebibyte / sizeof(std::uint32_t) + 3);
  std::iota(values.begin(), values.end(), 7u);
  const Buffer<std::uint32_t> buffer = device().pool.upload(values, "values");
  EXPECT_EQ(device().pool.download(buffer, values.size()), values);
}

TEST_F(Pages, HoldLargeBuffersThatBeginAtDifferentPlacesOfASmallPage) {
  LargePages pages;
  std::set<std::uintptr_t> places;
  for (int k = 0; k < 12; ++k) {
    const compute::buffer buffer = pages.buffer(device().context, 5 * mebibyte);
    const std::uintptr_t address = address_of(buffer);
    EXPECT_LT(address % (2 * mebibyte), 4096u);
    EXPECT_EQ(address % 128, 0u);  // OpenCL's largest values
    places.insert(address % 4096);
  }
  EXPECT_EQ(places.size(), 12u);
}

// Mapped by itself, or of the heap where that has room.
std::size_t bytes_in_use() {
  const auto found = mallinfo2();
  return found.hblkhd + found.uordblks;
}

TEST_F(Pages, GiveTheirMemoryBack) {
  LargePages pages;
  const std::size_t before = bytes_in_use();
  {
    const compute::buffer buffer = pages.buffer(device().context, 64 * mebibyte);
    EXPECT_GE(bytes_in_use(), before + 64 * mebibyte);
  }
  EXPECT_LT(bytes_in_use(), before + 64 * mebibyte);
}

// Copies to a GPU and back by way of memory that it can reach. A processor that is taken for one
// copies the same way.

class StagedCopiesTest : public StageTest {
 protected:
  static DeviceTraits traits_of_gpu() {
    DeviceTraits traits = device().traits;
    traits.is_gpu = true;
    traits.shares_host_memory = false;
    return traits;
  }

  static std::vector<std::uint32_t> numbers(std::size_t count) {
    std::vector<std::uint32_t> values(count);
    std::iota(values.begin(), values.end(), 7u);
    return values;
  }

  // What comes back of what was written.
  static std::vector<std::uint32_t> there_and_back(std::vector<std::uint32_t> values) {
    StagedCopies copies(device().context, device().queue, device().timer, traits_of_gpu());
    const std::size_t bytes = values.size() * sizeof(std::uint32_t);
    const compute::buffer buffer(device().context, bytes);
    copies.write(buffer, values.data(), bytes);
    std::fill(values.begin(), values.end(), 0u);
    copies.read(buffer, values.data(), bytes);
    return values;
  }
};

TEST_F(StagedCopiesTest, BringBackWhatWasWritten) {
  // More than all slots hold, and no whole number of them.
  for (const std::size_t count : {std::size_t{10}, std::size_t{2097152}, std::size_t{12345679}})
    EXPECT_TRUE(there_and_back(numbers(count)) == numbers(count)) << count;
}

TEST_F(StagedCopiesTest, ServeOneAfterTheOther) {
  StagedCopies copies(device().context, device().queue, device().timer, traits_of_gpu());
  const std::vector<std::uint32_t> first = numbers(5000000), second(5000000, 3u);
  const std::size_t bytes = first.size() * sizeof(std::uint32_t);
  const compute::buffer a(device().context, bytes), b(device().context, bytes);
  copies.write(a, first.data(), bytes);
  copies.write(b, second.data(), bytes);
  std::vector<std::uint32_t> read(first.size());
  copies.read(a, read.data(), bytes);
  EXPECT_TRUE(read == first);
  copies.read(b, read.data(), bytes);
  EXPECT_TRUE(read == second);
}

}  // namespace
}  // namespace splotchcl::test
