#include "parallel/available_memory.h"

#include <gtest/gtest.h>
#include <unistd.h>

namespace splotchcl {
namespace {

TEST(AvailableMemory, IsSomeOfWhatTheMachineHas) {
  const std::uint64_t all = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
                            static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  EXPECT_GT(available_memory(), 0u);
  EXPECT_LE(available_memory(), all);
}

TEST(AvailableMemory, HasRoomForCopiesOfSmallColumnsAlone) {
  EXPECT_FALSE(is_too_large_to_copy(0));
  EXPECT_FALSE(is_too_large_to_copy(16u << 20));
  EXPECT_TRUE(is_too_large_to_copy(available_memory()));
}

}  // namespace
}  // namespace splotchcl
