// Columns whose values are made when they are wanted.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>

#include "splotchcl/particles.h"

namespace splotchcl {
namespace {

// Value i is 2 i; counts how many were made.
class Doubles : public ColumnSource {
 public:
  std::size_t size() const override { return 1000; }
  void make(std::size_t begin, std::size_t end, float* values) const override {
    made += end - begin;
    for (std::size_t i = begin; i < end; ++i)
      values[i - begin] = static_cast<float>(2 * i);
  }
  mutable std::atomic<std::size_t> made{0};
};

class LaterValues : public ::testing::Test {
 protected:
  std::shared_ptr<const Doubles> source_ = std::make_shared<const Doubles>();
  Column column_ = Column::made_by(source_);
};

TEST_F(LaterValues, AreNotMadeBeforeTheyAreWanted) {
  EXPECT_TRUE(column_.is_array());
  EXPECT_EQ(column_.size(), 1000U);
  EXPECT_EQ(column_.source(), source_);
  EXPECT_EQ(source_->made, 0U);
}

TEST_F(LaterValues, AreMadeOneByOneForASample) {
  EXPECT_EQ(column_[500], 1000);
  EXPECT_EQ(column_[3], 6);
  EXPECT_EQ(source_->made, 2U);
}

TEST_F(LaterValues, AreMadeOnceForAllCopies) {
  const Column copy = column_;
  EXPECT_EQ(copy.data()[999], 1998);
  EXPECT_EQ(column_.data(), copy.data());
  EXPECT_EQ(column_[1], 2);
  EXPECT_EQ(source_->made, 1000U);
}

TEST_F(LaterValues, AreMadeAllWhereManyAreWantedOneByOne) {
  for (std::size_t i = 0; i < 1000; ++i)
    ASSERT_EQ(column_[i], static_cast<float>(2 * i));
  EXPECT_LT(source_->made, 1100U);
}

}  // namespace
}  // namespace splotchcl
