// Copies to a GPU and back by way of memory that it can reach. A processor that is taken for one
// copies the same way.
#include "device/opencl/staged_copies.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "device/stages.h"

namespace splotchcl::test {
namespace {

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
