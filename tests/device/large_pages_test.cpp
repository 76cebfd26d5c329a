#include "device/opencl/large_pages.h"

#include <gtest/gtest.h>
#include <malloc.h>

#include <cstdint>
#include <numeric>
#include <set>
#include <vector>

#include "device/stages.h"

namespace splotchcl::test {
namespace {

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

}  // namespace
}  // namespace splotchcl::test
