// Project and sort together give the oracle's order, index for index.
#include <gtest/gtest.h>

#include <vector>

#include "device/stages.h"

namespace splotchcl::test {
namespace {

// Clouds in the picture at the depths that `depth(random)` draws.
template <class Depth>
DrawnComponent clouds_at(Depth depth, int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Cloud> clouds;
  for (int i = 0; i < count; ++i) {
    const double z = depth(random);
    clouds.push_back({random.uniform(-20, 20), random.uniform(-20, 20), z, 1, 1});
  }
  return component_of(clouds, two_colors());
}

// Depths far from each other, and depths of which many are equal.
double any_depth(Random& random) {
  return random.logarithmic(1e-3, 1e6);
}
double one_of_ten_depths(Random& random) {
  return std::floor(random.uniform(0, 10));
}

// Sort keys around zero, of which many are equal.
Column field_values(std::size_t count) {
  Random random(9);
  std::vector<float> values;
  for (std::size_t i = 0; i < count; ++i) {
    const double value = std::floor(random.uniform(-50, 50)) / 8;
    values.push_back(i % 7 == 0 ? -0.0f : static_cast<float>(value));
  }
  return Column::owning(values);
}

void expect_order_of_the_oracle(DeviceContext& device, Frame frame) {
  frame = with_identities(frame);
  Stages stages(device, frame);
  const std::vector<std::uint64_t> order = stages.sorted_particles();
  std::vector<reference::Splat> expected = reference::project(frame);
  reference::sort(expected, frame.sort);
  ASSERT_EQ(order.size(), expected.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    ASSERT_EQ(order[i], expected[i].particle) << "at place " << i;
  }
}

using Order = StageTest;

TEST_F(Order, IsTheOraclesForAnyDepths) {
  expect_order_of_the_oracle(device(), frame_of(50, 50, {clouds_at(any_depth, 30011, 1)}));
}

TEST_F(Order, IsTheOraclesWhereManyDepthsAreEqual) {
  expect_order_of_the_oracle(device(), frame_of(50, 50, {clouds_at(one_of_ten_depths, 30011, 2)}));
}

TEST_F(Order, IsTheOraclesFarToNear) {
  Frame frame = frame_of(50, 50, {clouds_at(one_of_ten_depths, 30011, 3)});
  frame.sort.descending = true;
  expect_order_of_the_oracle(device(), frame);
}

TEST_F(Order, IsTheOraclesByAField) {
  for (const bool descending : {false, true}) {
    DrawnComponent component = clouds_at(any_depth, 30011, 4);
    component.particles.sort_field = field_values(component.particles.count);
    Frame frame = frame_of(50, 50, {component});
    frame.sort = {SortOrder::By::field, "key", descending};
    expect_order_of_the_oracle(device(), frame);
  }
}

// Blocks of the projection end inside components, and ties must keep components apart.
TEST_F(Order, IsTheOraclesAcrossComponents) {
  expect_order_of_the_oracle(
      device(), frame_of(50, 50,
                         {clouds_at(one_of_ten_depths, 9001, 5), clouds_at(one_of_ten_depths, 1, 6),
                          clouds_at(one_of_ten_depths, 20003, 7)}));
}

}  // namespace
}  // namespace splotchcl::test
