#include <gtest/gtest.h>

#include "ranks/mpi_library.h"

namespace splotchcl::test {
namespace {

TEST(SharedHost, SharesOutItsCores) {
  EXPECT_EQ(cores_of_rank(16, 16, 4), 4);
  EXPECT_EQ(cores_of_rank(16, 16, 3), 5);
  EXPECT_EQ(cores_of_rank(2, 2, 4), 1);
}

TEST(SharedHost, LeavesARankTheCoresThatItIsBoundTo) {
  EXPECT_EQ(cores_of_rank(16, 4, 4), 4);
  EXPECT_EQ(cores_of_rank(16, 1, 4), 1);
}

}  // namespace
}  // namespace splotchcl::test
